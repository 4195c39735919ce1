// Oracle: coordinates by hand, the frame of each drawing, and what poppler reads back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "document_fixture.h"
#include "platform/program_lookup.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_drawings {

using drawings = DocumentTest;
using test::inspect_pdf;
using testing::HasSubstr;

constexpr double kPixels = 96 / 2.54;  // a cm

std::string drawn(const std::string& name, const std::string& caption = "") {
    return "One.\n\n::: {.drawing name=" + name + "}\n" + caption + "\n:::\n";
}

std::vector<std::string> all_names() {
    std::vector<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(shared_folder() / "report_templates/drawings"))
        names.push_back(file.path().stem().string());
    return names;
}

/// The corners of all lines and areas of a page's drawings.
std::vector<std::pair<double, double>> corners(const std::string& page) {
    std::vector<std::pair<double, double>> result;
    const std::regex shape(R"re(points="([^"]*)")re"), corner(R"((-?[0-9.]+),(-?[0-9.]+))");
    for (std::sregex_iterator found(page.begin(), page.end(), shape), end; found != end; ++found) {
        const std::string points = (*found)[1];
        for (std::sregex_iterator one(points.begin(), points.end(), corner); one != end; ++one)
            result.emplace_back(std::stod((*one)[1]), std::stod((*one)[2]));
    }
    return result;
}

TEST_F(drawings, are_figures_with_number_caption_and_words_of_the_language) {
    const std::string text = "See @fig:rig.\n\n" + drawn("suspension", "The *suspension* {#fig:rig}");
    const std::string page = html(text);
    EXPECT_THAT(page, HasSubstr("<a href=\"#fig:rig\">Figure 1</a>"));
    EXPECT_THAT(page, HasSubstr("<figure id=\"fig:rig\"><svg"));
    const auto english = inspect_pdf(make(text, "out.pdf")).pages.at(0);
    const auto french = inspect_pdf(make("---\nlang: fr\n---\n" + text, "fr.pdf")).pages.at(0);
    for (const char* words : {"spring", "damper", "actuator", "Figure 1. The suspension"})
        EXPECT_THAT(english, HasSubstr(words));
    for (const char* words : {"ressort", "amortisseur", "actionneur"}) EXPECT_THAT(french, HasSubstr(words));
}

// The suspension's mass is a box from (3.4, 0.69) to (5.2, 2.05) cm in a drawing of 9.2 cm by 2.7 cm.
TEST_F(drawings, show_lengths_as_they_are) {
    const std::string page = html(drawn("suspension"));
    EXPECT_THAT(page, HasSubstr("viewBox=\"0 0 347.7 102.0\""));
    char box[100];
    std::snprintf(box, sizeof box, "%.1f,%.1f %.1f,%.1f %.1f,%.1f %.1f,%.1f", 3.4 * kPixels, 2.01 * kPixels,
                  5.2 * kPixels, 2.01 * kPixels, 5.2 * kPixels, 0.65 * kPixels, 3.4 * kPixels, 0.65 * kPixels);
    EXPECT_THAT(page, HasSubstr("<polygon points=\"" + std::string(box) + "\""));
}

TEST_F(drawings, lie_within_their_frames) {
    for (const std::string& name : all_names()) {
        const std::string page = html(drawn(name));
        std::smatch frame;
        ASSERT_TRUE(std::regex_search(page, frame, std::regex(R"re(viewBox="0 0 ([0-9.]+) ([0-9.]+)")re"))) << name;
        const std::regex label(R"re(<foreignObject x="(-?[0-9.]+)" y="-?[0-9.]+" width="([0-9.]+)")re");
        for (std::sregex_iterator found(page.begin(), page.end(), label), end; found != end; ++found) {
            EXPECT_GE(std::stod((*found)[1]), -0.1) << name << ": a label is cut off";
            EXPECT_LE(std::stod((*found)[1]) + std::stod((*found)[2]), std::stod(frame[1]) + 0.1) << name;
        }
        const auto shown = corners(page);
        EXPECT_GT(shown.size(), 50u) << name;
        for (const auto& [x, y] : shown) {
            EXPECT_TRUE(x >= 0 && x <= std::stod(frame[1])) << name << ": x = " << x / kPixels;
            EXPECT_TRUE(y >= 0 && y <= std::stod(frame[2])) << name << ": y = " << y / kPixels << " from above";
        }
    }
}

TEST_F(drawings, mistakes_are_reported_with_their_line) {
    const std::string unknown = refusal(drawn("crain"));
    EXPECT_THAT(unknown, HasSubstr("report.md:3: unknown drawing \"crain\""));
    EXPECT_THAT(unknown, HasSubstr("crane"));
    for (const std::string& name : all_names()) EXPECT_THAT(unknown, HasSubstr(name));
    EXPECT_THAT(refusal("::: drawing\n:::\n"), HasSubstr("unknown drawing \"\""));
    EXPECT_THAT(refusal(drawn("../filters/safety")), HasSubstr("unknown drawing \"../filters/safety\""));
    EXPECT_THAT(refusal(drawn("crane", "- a list")), HasSubstr("may contain only one line with its caption"));
    EXPECT_THAT(refusal("::: {.drawing name=crane onclick=run}\n:::\n"), HasSubstr("onclick"));
}

}  // namespace test_drawings
}  // namespace dynlab
