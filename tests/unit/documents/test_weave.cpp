#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "documents/latex_remains.h"
#include "documents/text_lines.h"
#include "documents/weave.h"
#include "figures/figure.h"

namespace dynlab {
namespace test_weave {

using testing::HasSubstr;
using testing::Not;

MarkdownText weave(const std::string& source, const RunRecord& record = {}) {
    return weave_cells(parse_percent_script(source, "lesson.lua"), record);
}

// Oracle of this file: the definition in weave.h; every origin is checked by looking the line up in the script.

TEST(weave, every_line_knows_its_line_of_the_script) {
    const std::string source = "-- %% [markdown]\n-- # One\n--\n-- two\n-- %%\n\nlocal x = 1\nlocal y = 2\n";
    const MarkdownText text = weave(source);
    const std::vector<std::string> script = lines_of(source), woven = lines_of(text.text);
    ASSERT_EQ(woven.size(), text.origin.size());
    for (std::size_t i = 0; i < woven.size(); ++i) {
        if (woven[i].empty() || woven[i].starts_with("```")) continue;
        const Place from = text.origin_of(static_cast<int>(i) + 1);
        EXPECT_EQ(from.file, "lesson.lua");
        EXPECT_THAT(script.at(static_cast<std::size_t>(from.line) - 1), HasSubstr(woven[i]));
    }
    EXPECT_EQ(text.origin_of(0).line, 0);
    EXPECT_EQ(text.origin_of(1000).line, 0);
}

TEST(weave, shows_code_output_and_figures_in_order) {
    RunRecord record;
    record.outputs["cell-1"] = {{"first\n", "cell-1-figure-1"}, {"second\n", std::nullopt}};
    record.figures["cell-1-figure-1"].caption = "Title";
    const std::string text = weave("-- %%\nplot(x)\n", record).text;
    const std::size_t code = text.find("```{.lua .cell}\nplot(x)\n```"), first = text.find("```{.output}\nfirst\n```"),
                      figure = text.find("![](figure:cell-1-figure-1){#fig:cell-1-figure-1}"),
                      second = text.find("```{.output}\nsecond\n```");
    ASSERT_NE(second, std::string::npos);
    EXPECT_LT(code, first);
    EXPECT_LT(first, figure);
    EXPECT_LT(figure, second);
}

TEST(weave, figures_without_a_caption_are_numbered_and_say_what_their_axes_do) {
    RunRecord record;
    record.outputs["a"] = {{"", "a-figure-1"}, {"", "a-figure-2"}};
    const auto figure = std::make_shared<Figure>();
    figure->panels.resize(3);
    figure->panels[0].y_label = Message("y_1 (m)"),
    figure->panels[1].y_label = figure->panels[2].y_label = Message("voltage (V)");
    figure->panels[2].x_label = axis_label(Message("time"), "s");
    record.figures["a-figure-1"].figure = figure;
    record.figures["a-figure-2"].figure = std::make_shared<Figure>(Panel());
    const std::string text = weave("-- %% id=a\nplot(x)\n", record).text;
    EXPECT_THAT(text, HasSubstr("![y\\_1 (m), voltage (V) over time (s)](figure:a-figure-1){#fig:a-figure-1}"));
    figure->panels[0].y_label = Message("thrust (N)");
    EXPECT_THAT(weave("-- %% id=a\nplot(x)\n", record).text, HasSubstr("![Thrust (N), voltage (V) over"));
    figure->panels[0].y_label = Message("écart b_{0} e^{-a t}");
    EXPECT_THAT(weave("-- %% id=a\nplot(x)\n", record).text, HasSubstr("![Écart b~0~ e^-a\\ t^, voltage (V) over"));
    EXPECT_THAT(text, HasSubstr("![From the cell `a`](figure:a-figure-2){#fig:a-figure-2}"));
    EXPECT_THAT(weave("-- ---\n-- title: Essai\n-- language: fr\n-- ---\n-- %% id=a\nplot(x)\n", record).text,
                HasSubstr("voltage (V) en fonction du temps (s)]"));
}

TEST(weave, captions_of_histograms_name_what_is_counted) {
    RunRecord record;
    record.outputs["a"] = {{"", "a-figure-1"}};
    const auto figure = std::make_shared<Figure>();
    figure->panels.resize(4);
    for (Panel& panel : figure->panels) panel.curves.emplace_back().style = CurveStyle::kBars;
    figure->panels[0].y_label = Message("lssvf"), figure->panels[2].y_label = Message("tfsrivc");
    figure->panels[2].x_label = Message("a_{1}"), figure->panels[3].x_label = Message("b_{0}");
    record.figures["a-figure-1"].figure = figure;
    EXPECT_THAT(weave("-- %% id=a\nplot(x)\n", record).text,
                HasSubstr("![Histograms of a~1~, b~0~: lssvf, tfsrivc](figure:a-figure-1)"));
}

// Oracle: what a reader of LaTeX takes for a formula, and what CommonMark prints for the number of a character.
TEST(weave, units_in_brackets_at_the_axes_are_no_formula) {
    RunRecord record;
    record.outputs["a"] = {{"", "a-figure-1"}};
    Panel panel;
    panel.y_label = Message("voltage [V]"), panel.x_label = Message("R&D [s]");
    record.figures["a-figure-1"].figure = std::make_shared<Figure>(panel);
    const MarkdownText woven = weave("-- %% id=a\nplot(x)\n", record);
    EXPECT_THAT(woven.text, HasSubstr("![Voltage &#91;V&#93; versus R\\&D &#91;s&#93;](figure:a-figure-1)"));
    Complaints complaints;
    find_latex_brackets(woven, complaints);
    EXPECT_TRUE(complaints.empty());
}

TEST(weave, options_hide_code_or_output) {
    RunRecord record;
    record.outputs["a"] = record.outputs["b"] = {{"printed\n", std::nullopt}};
    EXPECT_THAT(weave("-- %% id=a echo=false\nx = 1\n", record).text, Not(HasSubstr("x = 1")));
    EXPECT_THAT(weave("-- %% id=a echo=false\nx = 1\n", record).text, HasSubstr("printed"));
    EXPECT_THAT(weave("-- %% id=b output=false\nx = 1\n", record).text, Not(HasSubstr("printed")));
}

TEST(weave, markers_and_starters_are_never_shown) {
    const std::string text = weave(
                                 "-- %%\n-- BEGIN SOLUTION\nlocal K = 2\n-- STARTER: local K = 1\n-- END SOLUTION\n"
                                 "-- %% [markdown]\n-- BEGIN SOLUTION\n-- Because.\n-- END SOLUTION\n")
                                 .text;
    EXPECT_THAT(text, HasSubstr("local K = 2"));
    EXPECT_THAT(text, HasSubstr("Because."));
    EXPECT_THAT(text, Not(HasSubstr("SOLUTION")));
    EXPECT_THAT(text, Not(HasSubstr("STARTER")));
}

TEST(weave, no_output_can_close_its_block) {
    RunRecord record;
    record.outputs["cell-1"] = {{"```\n# not a heading\n````\n", std::nullopt}};
    EXPECT_THAT(weave("-- %%\nx = 1\n", record).text, HasSubstr("`````{.output}\n```\n# not a heading\n````\n`````\n"));
}

TEST(weave, empty_lines_at_the_end_of_an_output_are_not_shown) {
    RunRecord record;
    record.outputs["cell-1"] = {{"a\n\nb\n\n", std::nullopt}, {"\n\n", std::nullopt}};
    const std::string text = weave("-- %%\nx = 1\n", record).text;
    EXPECT_THAT(text, HasSubstr("```{.output}\na\n\nb\n```\n"));
    EXPECT_EQ(text.find("{.output}"), text.rfind("{.output}"));
}

TEST(weave, a_recorded_error_is_at_its_cell) {
    RunRecord record;
    record.error = RecordedError{Message("x is nil"), "lesson.lua", 2};
    const std::string text = weave("-- %%\nx()\n-- %% [markdown]\n-- after\n", record).text;
    EXPECT_LT(
        text.find("```{.error}\nlesson.lua:2: x is nil\nThe script stopped here; the cells below were not run.\n```"),
        text.find("after"));
}

}  // namespace test_weave
}  // namespace dynlab
