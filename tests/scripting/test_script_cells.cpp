// Oracle: the attribution rules written in the script itself (cell ids and what each cell prints and draws).
#include <gtest/gtest.h>

#include "documents/percent_script.h"
#include "script_run.h"

namespace test_script_cells {

using namespace dynlab;

RunRecord run_script(const std::string& source) {
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    return runtime.run(parse_percent_script(source, "lesson.lua"));
}

const char* const kScript =
    "-- %% id=first\n"
    "local function show(x) print('value ' .. x) end\n"
    "show(1)\n"
    "-- %% [markdown]\n"
    "-- Words.\n"
    "-- %% id=second\n"
    "show(2)\n"
    "plot({1, 2}, {3, 4})\n"
    "print('after')\n"
    "local co = coroutine.wrap(function() coroutine.yield() print('resumed') end)\n"
    "co()\n"
    "-- %% id=third\n"
    "co()\n"
    "for i = 1, 3 do plot({1, 2}, {i, i + 1}, {title = 'picture ' .. i}) end\n";

TEST(script_cells, get_what_their_lines_print_and_draw) {
    const RunRecord record = run_script(kScript);
    ASSERT_FALSE(record.error) << record.error->message;
    ASSERT_EQ(record.outputs.at("first").size(), 1u);
    EXPECT_EQ(record.outputs.at("first")[0].printed, "value 1\n");
    const auto& second = record.outputs.at("second");
    ASSERT_EQ(second.size(), 2u);
    EXPECT_EQ(second[0].printed, "value 2\n");
    EXPECT_EQ(second[0].figure, "second-figure-1");
    EXPECT_EQ(second[1].printed, "after\n");
    EXPECT_FALSE(second[1].figure);
    const auto& third = record.outputs.at("third");
    ASSERT_EQ(third.size(), 3u);
    EXPECT_EQ(third[0].printed, "resumed\n");
    EXPECT_EQ(record.figures.at("third-figure-3").caption, "picture 3");
    EXPECT_EQ(record.figures.size(), 4u);
    for (const char* cell : {"second", "third"}) EXPECT_GE(record.timings.at(cell), 0);
}

TEST(script_cells, keep_what_came_before_an_error) {
    const RunRecord record =
        run_script("-- %% id=a\nprint('one')\n-- %% id=b\nprint('two')\nzeors(1)\n-- %% id=c\nprint('three')\n");
    ASSERT_TRUE(record.error);
    EXPECT_EQ(record.error->line, 5);
    EXPECT_EQ(record.outputs.at("b")[0].printed, "two\n");
    EXPECT_EQ(record.outputs.count("c"), 0u);
}

TEST(script_cells, capture_only_figures_that_are_not_used_elsewhere) {
    const RunRecord record = run_script(
        "-- %% id=a\n"
        "local f = plot({1, 2}, {1, 2})\n"
        "report.figure('raw', f, 'Raw data')\n"
        "subplot(1, 2, {plot({1, 2}, {1, 2}), plot({1, 2}, {2, 1})})\n"
        "figure(1) plot({1, 2}, {5, 5})\n"
        "figure(1) plot({1, 2}, {6, 6})\n"
        "f:mark(1, 1, 'start')\n");
    ASSERT_FALSE(record.error) << record.error->message;
    EXPECT_EQ(record.figures.at("raw").caption, "Raw data");
    EXPECT_EQ(record.figures.at("raw").figure.panels[0].annotations.at(0).text, "start");
    EXPECT_EQ(record.figures.at("a-figure-1").figure.panels.size(), 2u);
    EXPECT_EQ(record.figures.at("a-figure-2").figure.panels[0].curves[0].y[0], 6);
    EXPECT_EQ(record.figures.size(), 3u);
}

TEST(script_cells, report_values_tables_and_texts) {
    const RunRecord record = run_script(
        "-- %% id=a\nreport.value('fit', 93.254, '%.1f')\nreport.value('name', 'P1')\nreport.value('n', 3)\n"
        "report.table('models', {{'Model', 'Fit'}, {'P1', 93.25}, {'P2', 7}})\nreport.text('note', '*good*')\n");
    ASSERT_FALSE(record.error) << record.error->message;
    EXPECT_EQ(record.values.at("fit").text, "93.3");
    EXPECT_EQ(record.values.at("fit").number, 93.254);
    EXPECT_EQ(record.values.at("name").text, "P1");
    EXPECT_EQ(record.values.at("n").text, "3");
    EXPECT_EQ(record.tables.at("models").header, (std::vector<std::string>{"Model", "Fit"}));
    EXPECT_EQ(record.tables.at("models").rows[0], (std::vector<std::string>{"P1", "93.25"}));
    EXPECT_EQ(record.texts.at("note").markdown, "*good*");
}

TEST(script_cells, show_curves_as_described) {
    const RunRecord record = run_script(
        "-- %% id=a\nplot({0, 1}, {1, 2}, 'a', {0, 1}, {3, 4}, 'b', {style = {'points', 'line'}, xlabel = 'time (s)', "
        "x_range = {0, 2},\n"
        "references = {{y = 2, label = 'level'}}})\n");
    ASSERT_FALSE(record.error) << record.error->message;
    const Panel& panel = record.figures.at("a-figure-1").figure.panels.at(0);
    EXPECT_EQ(panel.curves.at(0).label, "a");
    EXPECT_EQ(panel.curves.at(0).style, CurveStyle::kPoints);
    EXPECT_EQ(panel.curves.at(1).y[1], 4);
    EXPECT_EQ(panel.x_label, "time (s)");
    EXPECT_EQ(panel.x_range->second, 2);
    EXPECT_TRUE(panel.references.at(0).horizontal);
    EXPECT_EQ(test::error_of("plot({1, 2}, {1, 2}, {xlable = 'x'})"),
              "lesson.lua:1: plot: option 'xlable' is unknown; did you mean 'xlabel'?");
    EXPECT_EQ(
        test::error_of("plot({1, 2}, {1, 2}, '--')"),
        "lesson.lua:1: plot: a text names the curve; for the look \"--\" write {style = \"points\"} or {dash = 1}");
    EXPECT_EQ(test::error_of("save(plot({1, 2}, {1, 2}), '/etc/x.pdf')"),
              "lesson.lua:1: save: '/etc/x.pdf' lies outside the script's folder and the output folder; scripts write "
              "only there");
}

}  // namespace test_script_cells
