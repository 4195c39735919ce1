// Animated plants, from scripts. Oracle: the drawings as documents show them, and sentences by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "documents/document.h"
#include "figures/figure.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "script_run.h"
#include "scripting/objects/plant_drawing.h"
#include "support/environment_variable.h"

namespace test_script_motion {
using namespace dynlab;
using dynlab::test::error_of;
using testing::HasSubstr;

const std::string kDataSet = "local t = linspace(0, 2, 201)\nlocal s = {position = 0*t, angle = 0.2*sin(5*t)}\n";

/// A page of the drawing alone.
std::string page_of(const std::string& name) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "report.md") << "::: {.drawing name=" << name << "}\n:::\n";
    DocumentSource source;
    source.template_file = folder.path() / "report.md";
    DocumentMaker({.use_cache = false}).make(source, folder.path() / "page.html", DocumentFormat::kHtml, nullptr);
    return read_text(folder.path() / "page.html");
}

TEST(script_motion, plants_are_made_of_the_shapes_of_documents) {
    for (const char* name : {"crane", "drifting_process", "drive", "thruster", "two_tanks"}) {
        const PlantDrawing plant = plant_drawing(name);
        const std::string page = page_of(name);
        Vector drawn(static_cast<Index>(plant.parts.size()));
        for (std::size_t k = 0; k < plant.parts.size(); ++k) drawn[static_cast<Index>(k)] = plant.parts[k].drawn_at;
        std::size_t moving = 0;
        for (const PlantShape& piece : plant.pieces) {
            const PlantShape there = plant.placed(piece, drawn);
            std::string points;
            for (std::size_t i = 0; i < there.x.size(); ++i)
                points += fmt::format("{}{:.1f},{:.1f}", i ? " " : "", there.x[i] * 96 / 2.54,
                                      (plant.height - there.y[i]) * 96 / 2.54);
            EXPECT_THAT(page, HasSubstr("\"" + points + "\"")) << name;
            moving += piece.moves();
        }
        const bool many = std::string(name) == "crane" || std::string(name) == "thruster";
        EXPECT_GE(moving, many ? 8u : 2u) << name;
    }
    EXPECT_EQ(plant_drawing("crane").parts[1].on, 0);
    EXPECT_EQ(plant_drawing("thruster").parts[0].unit, "N");
}

TEST(script_motion, keeps_signals_and_plant_in_one_figure) {
    const RunRecord record = test::run(kDataSet +
                                       "report.figure('m', motion{plant = 'crane', t = t, measured = s,\n"
                                       "simulated = s, instants = {0.5, 1.5}, title = 'Both', width = 12}, '')");
    ASSERT_FALSE(record.error) << record.error->text();
    const Figure& figure = *record.figures.at("m").figure;
    ASSERT_TRUE(figure.motion);
    EXPECT_EQ(message_text(figure.panels[1].y_label), "position (m)");
    EXPECT_EQ(figure.panels[2].curves.size(), 2u);
    EXPECT_EQ(figure.panels[1].references.size(), 2u);
    EXPECT_EQ(message_text(figure.title), "Both");
    EXPECT_EQ(figure.width_cm, 12);
}

TEST(script_motion, where_scripts_are_graded_draws_nothing_and_stops_nothing) {
    RunOptions graded;
    graded.graded = true;
    const test::EnvironmentVariable home("DYNLAB_HOME", "/nowhere");
    for (const char* options : {"measured = s", "measured = t", "measured = {angle = t, more = t}, simulated = s"}) {
        const RunRecord record = test::run(kDataSet + "motion{plant = 'crane', t = t, " + options + "}", graded);
        EXPECT_FALSE(record.error) << options << ": " << record.error->text();
    }
}

TEST(script_motion, says_what_is_missing) {
    const auto reported = [](const std::string& options) { return error_of(kDataSet + "motion{" + options + "}"); };
    EXPECT_THAT(
        reported("t = t, measured = s"),
        HasSubstr("unknown animated plant ''; the plants are crane, drifting_process, drive, thruster, two_tanks"));
    EXPECT_THAT(reported("plant = 'suspension', t = t, measured = s"),
                HasSubstr("unknown animated plant 'suspension'"));
    EXPECT_THAT(
        reported("plant = 'crane', t = t, measured = {angle = s.angle}"),
        HasSubstr(
            "option 'measured' does not contain the signal position (m), which the animation of the plant needs"));
    EXPECT_THAT(reported("plant = 'thruster', t = t, simulated = {force = {1, 2}}"),
                HasSubstr("the simulated force has 2 values for 201 instants"));
    EXPECT_THAT(reported("plant = 'thruster', t = t, simulated = {force = 'much'}"),
                HasSubstr("the simulated force must be a vector, but it is"));
    EXPECT_THAT(reported("plant = 'crane', t = t, measured = 3"), HasSubstr("must be a table such as {position = y}"));
    EXPECT_THAT(reported("plant = 'crane', t = t"), HasSubstr("measured or simulated"));
    EXPECT_THAT(reported("plant = 'crane', time = t, measured = s"), HasSubstr("time"));
}

}  // namespace test_script_motion
