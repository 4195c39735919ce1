// Oracle: the drawing's coordinates by hand, and what poppler reads back.
#include <gmock/gmock.h>

#include <regex>

#include "document_fixture.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_block_diagrams {

using block_diagrams = DocumentTest;
using test::inspect_pdf;
using testing::HasSubstr;
using testing::Not;

std::string diagram(const std::string& list, const std::string& caption = "") {
    return "One.\n\n::: block-diagram\n" + list + (caption.empty() ? "" : "\n" + caption + "\n") + ":::\n";
}

const char* const kLoop =
    "- r = signal 1 1: $r$\n- S = sum 2 1\n- G = block 3 1: plant\n- H = block 3 2: sensor\n- r -> S -> G: $u$\n"
    "- G -> H\n- H -| S\n";

TEST_F(block_diagrams, are_figures_with_number_caption_and_label) {
    const std::string page = html("See @fig:loop.\n\n" + diagram(kLoop, "The loop {#fig:loop}"));
    EXPECT_THAT(page, HasSubstr("<a href=\"#fig:loop\">Figure 1</a>"));
    EXPECT_THAT(page, HasSubstr("<figure id=\"fig:loop\"><svg"));
    EXPECT_THAT(page, HasSubstr("The loop"));
    EXPECT_THAT(page, HasSubstr("plant"));
    const auto content = inspect_pdf(make("See @fig:loop.\n\n" + diagram(kLoop, "The loop {#fig:loop}"), "out.pdf"));
    for (const char* text : {"plant", "sensor", "Figure 1. The loop"})
        EXPECT_THAT(content.pages.at(0), HasSubstr(text));
}

// Three columns of 3 cm, two rows of 1.5 cm, 96/2.54 pixels a centimetre: the sum's center is 4.5 cm from the left and
// 0.75 cm from above, its rim 0.25 cm below; the sensor's left edge 7.5 - 2.05/2 cm from the left.
TEST_F(block_diagrams, arrows_go_from_rim_to_rim) {
    const std::string page = html(diagram(kLoop));
    const double px = 96 / 2.54;
    const std::regex line(R"re(<line x1="([0-9.]+)" y1="([0-9.]+)" x2="([0-9.]+)" y2="([0-9.]+)")re");
    std::vector<std::vector<double>> lines;
    for (std::sregex_iterator found(page.begin(), page.end(), line), end; found != end; ++found)
        lines.push_back(
            {std::stod((*found)[1]), std::stod((*found)[2]), std::stod((*found)[3]), std::stod((*found)[4])});
    ASSERT_EQ(lines.size(), 5u) << "three straight arrows and one with a corner";
    const double back[2][4] = {{7.5 - 1.025, 2.25, 4.5, 2.25}, {4.5, 2.25, 4.5, 1.0}};
    for (std::size_t piece = 0; piece < 2; ++piece)
        for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(lines[3 + piece][i], back[piece][i] * px, 0.06) << piece << i;
}

TEST_F(block_diagrams, mistakes_are_reported_with_their_line) {
    for (const auto& [list, reported] : {std::pair("- r = dot 1 1: $r$\n", "unknown kind \"dot\""),
                                         {"- r = block 1: $r$\n", "a node must have the form NAME = KIND COLUMN ROW"},
                                         {"- r = block 0 1: $r$\n", "whole numbers from 1 to 12"},
                                         {"- r = block 99 1: $r$\n", "whole numbers from 1 to 12"},
                                         {"- r -> S\n", "the node r is not defined above this line"}}) {
        const std::string message = refusal(diagram(list));
        EXPECT_THAT(message, HasSubstr("report.md:4: ")) << list;
        EXPECT_THAT(message, HasSubstr(reported)) << list;
    }
    EXPECT_THAT(refusal(diagram("- a = sum 1 1\n- b = sum 2 2\n- a -> b\n")),
                HasSubstr("report.md:6: in the block diagram \"a -> b\": the arrow -> requires a and b in "
                          "different cells of one row or one column"));
    EXPECT_THAT(refusal(diagram("Words.\n")), HasSubstr("must be a list of nodes and arrows"));
}

TEST_F(block_diagrams, only_checked_labels_reach_latex_and_html) {
    write("secret.tex", "SECRETWORD");
    EXPECT_THAT(refusal(diagram("- r = block 1 1: $\\input{secret.tex}$\n"), "out.pdf"),
                HasSubstr("the command \\input"));
    EXPECT_NE(refusal(diagram("- r}\\input{secret.tex} = block 1 1: x\n"), "out.pdf"), "");
    EXPECT_NE(refusal(diagram("- r = block 1 1: <script>alert(1)</script>\n"), "out.html"), "");
    const std::string page = html(diagram("- r = block 1 1: a < b & \"c\"\n"));
    EXPECT_THAT(page, HasSubstr("a &lt; b &amp;"));
}

}  // namespace test_block_diagrams
}  // namespace dynlab
