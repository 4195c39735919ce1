// Oracle: the attribution rules written in the script itself (cell ids and what each cell prints and draws).
#include <gtest/gtest.h>

#include "data_io/values/cbor_values.h"
#include "documents/figure_description.h"
#include "documents/percent_script.h"
#include "platform/temporary_folder.h"
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
    ASSERT_FALSE(record.error) << record.error->text();
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
    ASSERT_FALSE(record.error) << record.error->text();
    EXPECT_EQ(record.figures.at("raw").caption, "Raw data");
    EXPECT_EQ(record.figures.at("raw").figure->panels[0].annotations.at(0).text, Message::verbatim("start"));
    EXPECT_EQ(record.figures.at("a-figure-1").figure->panels.size(), 2u);
    EXPECT_EQ(record.figures.at("a-figure-2").figure->panels[0].curves[0].y[0], 6);
    EXPECT_EQ(record.figures.size(), 3u);
}

TEST(script_cells, report_values_tables_and_texts) {
    const RunRecord record = run_script(
        "-- %% id=a\nreport.value('fit', 93.254, '%.1f')\nreport.value('name', 'P1')\nreport.value('n', 3)\n"
        "report.table('models', {{'Model', 'Fit'}, {'P1', 93.25}, {'P2', 7}})\nreport.text('note', '*good*')\n");
    ASSERT_FALSE(record.error) << record.error->text();
    EXPECT_EQ(record.values.at("fit").text, "93.3");
    EXPECT_EQ(record.values.at("fit").number, 93.254);
    EXPECT_EQ(record.values.at("name").text, "P1");
    EXPECT_EQ(record.values.at("n").text, "3");
    EXPECT_EQ(record.tables.at("models").header, (std::vector<std::string>{"Model", "Fit"}));
    EXPECT_EQ(record.tables.at("models").rows[0], (std::vector<std::string>{"P1", "93.25"}));
    EXPECT_EQ(record.texts.at("note").markdown, "*good*");
}

TEST(script_cells, report_values_are_written_as_numbers_are) {  // oracle: by hand
    const RunRecord record = run_script(
        "report.value('many', 123456)\nreport.value('half', 0.5)\nreport.value('none', 0/0, '%.2f')\n"
        "report.value('all', 1/0, '%.1f')\nreport.value('zero', -0.001, '%.2f')\nreport.value('less', -0.01, '%.2f')\n"
        "report.value('whole', 7, '%03d')\n");
    ASSERT_FALSE(record.error) << record.error->text();
    const auto text = [&](const char* name) { return record.values.at(name).text; };
    EXPECT_EQ(text("many"), "123456");
    EXPECT_EQ(text("half"), "0.5");
    EXPECT_EQ(text("none"), "NaN");
    EXPECT_EQ(text("all"), "Inf");
    EXPECT_EQ(text("zero"), "0.00");
    EXPECT_EQ(text("less"), "-0.01");
    EXPECT_EQ(text("whole"), "007");
}

TEST(script_cells, report_values_refuse_a_format_for_other_values) {
    EXPECT_EQ(test::error_of("report.value('n', 3.5, '%d')"),
              "lesson.lua:1: report.value: argument 3 (format) must be a format for one value, such as \"%.3f\", but "
              "\"%d\" cannot format 3.5");
    for (const char* call :
         {"report.value('n', 3, '%d %d')", "report.value('n', 3, '%y')", "report.value('n', 'x', '%d')"})
        EXPECT_TRUE(test::error_of(call).starts_with("lesson.lua:1: report.value: argument 3 (format) must be"))
            << call;
}

TEST(script_cells, handles_are_where_the_numbers_of_sliders_put_them) {
    const RunRecord record = run_script(
        "-- %% id=a\nlocal T = slider('T', 2, 1, 4, {log = true})\nlocal K = slider('K', 3, 0, 10)\n"
        "local f = plot({1, 2}, {1, 2})\n"
        "f:handle{x = function(T) return 10/T end, x_slider = 'T', y = function(K) return 0.632*K end, y_slider = 'K', "
        "text = '63 %'}\nreport.figure('f', f)\n");
    ASSERT_FALSE(record.error) << record.error->text();
    const Annotation& handle = record.figures.at("f").figure->panels[0].annotations.at(0);
    EXPECT_EQ(handle.x, 5);
    EXPECT_DOUBLE_EQ(handle.y, 0.632 * 3);
    EXPECT_EQ(message_text(handle.text), "63 %");
    ASSERT_EQ(handle.scales.size(), 2u);
    const SliderScale& along = handle.scales[0];
    EXPECT_EQ(along.slider, "T");
    EXPECT_TRUE(along.horizontal);
    EXPECT_EQ(along.value, 2);
    EXPECT_EQ(along.values[0], 1);
    EXPECT_NEAR(along.values[10], 2, 1e-12);  // the middle of its logarithm
    EXPECT_EQ(along.values[20], 4);
    for (Index i = 0; i < along.values.size(); ++i) EXPECT_DOUBLE_EQ(along.places[i], 10 / along.values[i]);
    EXPECT_FALSE(handle.scales[1].horizontal);
    EXPECT_DOUBLE_EQ(handle.scales[1].places[20], 6.32);
    const Figure again = from_cbor<Figure>(cbor_of(*record.figures.at("f").figure));  // as caches keep it
    ASSERT_EQ(again.panels.at(0).annotations.at(0).scales.size(), 2u);
    EXPECT_EQ(again.panels[0].annotations[0].scales[0].places, along.places);
}

TEST(script_cells, handles_that_cannot_move_say_why) {
    const std::string begin = "local k = slider('k', 1, -1, 2)\nlocal f = plot({1, 2}, {1, 2})\nf:handle";
    for (const auto& [call, sentence] : std::vector<std::pair<std::string, std::string>>{
             {"{x = 1, y = 2}", "x or y of a handle must be a function of the slider value"},
             {"{x = 1}", "a handle needs y = number, or y = function(slider value) and y_slider = \"NAME\""},
             {"{x = 1, x_slider = 'k', y = 1}", "a handle needs x = number, or x = function"},
             {"{x = abs, y = 1}", "'x' is a function, so the option x_slider = \"NAME\" must name its slider"},
             {"{x = abs, x_slider = 'l', y = 1}", "the slider \"l\" does not exist yet"},
             {"{x = math.abs, x_slider = 'k', y = 1}",
              "the function 'x' of the handle must be monotonic for the slider \"k\" from -1 to 2"},
             {"{x = print, x_slider = 'k', y = 1}", "must return a number, but for -1 it returned nil"},
             {"{x = math.log, x_slider = 'k', y = 1}", "must be monotonic for"},
             {"{y = function(k) return k.a end, y_slider = 'k', x = 1}", "is a number, so it has no fields"}})
        EXPECT_THAT(test::error_of(begin + call), testing::HasSubstr(sentence)) << call;
}

TEST(script_cells, sliders_are_their_own_number_and_are_recorded) {
    const RunRecord record = run_script(
        "-- %% id=a\nlocal k = slider('k', 3, 1, 10)\n-- %% id=b\nlocal l = slider('l', 2, 0.5, 8, {log = true, unit = "
        "'s'})\nprint(k + l)\n");
    ASSERT_FALSE(record.error) << record.error->text();
    EXPECT_EQ(record.outputs.at("b").front().printed, "5\n");
    const RecordedSlider& slider = record.sliders.at("l");
    EXPECT_EQ(slider.value, 2);
    EXPECT_EQ(slider.from, 0.5);
    EXPECT_EQ(slider.to, 8);
    EXPECT_TRUE(slider.logarithmic);
    EXPECT_EQ(slider.unit, "s");
    EXPECT_EQ(slider.label, "l");
    EXPECT_EQ(slider.cell, "b");
    EXPECT_EQ(test::printed(
                  "print(\"run\" .. slider('k', 2, 1, 3, {step = 1}), 'run' .. slider('l', 2, 1, 3, {step = 0.5}))"),
              "run2\trun2.0\n");
    EXPECT_EQ(record_from_json(to_json(record)).sliders.at("k").to, 10);
    for (const auto& [call, sentence] : std::vector<std::pair<std::string, std::string>>{
             {"slider('k', 3, 10, 1)", "the range of the slider \"k\" must increase, but it is from 10 to 1"},
             {"slider('k', 0, 1, 2)", "the value of the slider \"k\" must be between 1 and 2, but it is 0"},
             {"slider('k', 1, 0, 2, {log = true})", "must start at a positive number"},
             {"slider('k', 1, 0, 2, {step = -1})", "must be greater than 0 and at most 2"},
             {"slider('k', 1, 1, 2, {log = true, step = 1})", "cannot have both log = true and a step"},
             {"slider('k', 1, 1, 2) slider('k', 1, 1, 2)", "is already used"},
             {"slider('a b', 1, 1, 2)", "is not valid: use only letters"},
             {"slider('k', 0/0, 1, 2)", "must be between 1 and 2"}})
        EXPECT_THAT(test::error_of(call), testing::HasSubstr(sentence)) << call;
}

/// A study's scatter says how many estimates lie outside its ranges, those that a script sets, too. Oracle: all
/// estimates are (1, 1) but one, and the truth is (4, 3).
TEST(script_cells, other_ranges_are_counted_again) {
    const auto title = [](const std::string& set) {
        const RunRecord record = run_script(
            "-- %% id=a\nlocal n = 0\n"
            "local function one(d) n = n + 1 return vector{n == 3 and 1000 or 1, 1, 1} end\n"
            "local M = montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = "
            "20, "
            "estimators = {one = one}}\nlocal f = M:scatter('a1', 'a2')\nf:set{" +
            set + "}\n");
        EXPECT_FALSE(record.error);
        return message_text(record.figures.at("a-figure-1").figure->panels.at(0).title);
    };
    EXPECT_EQ(title(""), "1 of 20 outside the axes");
    EXPECT_EQ(title("x_range = {2, 5}"), "20 of 20 outside the axes");
    EXPECT_EQ(title("x_range = {0, 2000}"), "");
    EXPECT_EQ(title("x_range = {0, 2000}, y_range = {2, 5}"), "20 of 20 outside the axes");
    EXPECT_EQ(title("x_range = {2, 5}, title = 'all'"), "all");
    EXPECT_EQ(title("title = '1 of 20 outside the axes'} f:set{x_range = {2, 5}"), "1 of 20 outside the axes")
        << "it is the author's";
}

TEST(script_cells, show_curves_as_described) {
    const RunRecord record = run_script(
        "-- %% id=a\nplot({0, 1}, {1, 2}, 'a', {0, 1}, {3, 4}, 'b', {style = {'points', 'line'}, xlabel = 'time (s)', "
        "x_range = {0, 2},\n"
        "references = {{y = 2, label = 'level'}}})\n");
    ASSERT_FALSE(record.error) << record.error->text();
    const Panel& panel = record.figures.at("a-figure-1").figure->panels.at(0);
    EXPECT_EQ(message_text(panel.curves.at(0).label), "a");
    EXPECT_EQ(panel.curves.at(0).style, CurveStyle::kPoints);
    EXPECT_EQ(panel.curves.at(1).y[1], 4);
    EXPECT_EQ(message_text(panel.x_label), "time (s)");
    EXPECT_EQ(panel.x_range->second, 2);
    EXPECT_TRUE(panel.references.at(0).horizontal);
    EXPECT_EQ(test::error_of("plot({1, 2}, {1, 2}, {xlable = 'x'})"),
              "lesson.lua:1: plot: unknown option 'xlable'; did you mean 'xlabel'?");
    EXPECT_EQ(
        test::error_of("plot({1, 2}, {1, 2}, '--')"),
        "lesson.lua:1: plot: a string is the name of the curve; for the style \"--\", use {style = \"points\"} or "
        "{dash = 1}");
    EXPECT_EQ(
        test::error_of("save(plot({1, 2}, {1, 2}), '/etc/x.pdf')"),
        "lesson.lua:1: save: '/etc/x.pdf' is outside the script's folder and the output folder; scripts can write "
        "only to these folders and their subfolders");
}

TEST(script_cells, a_figure_with_an_unknown_ending_is_refused_with_all_endings) {
    const TemporaryFolder folder;
    RunOptions options;
    options.out_folder = options.script_folder = folder.path();
    EXPECT_EQ(test::error_of("save(plot({1, 2}, {1, 2}), 'a.jpg')", options),
              "lesson.lua:1: save: a figure must be saved as .pdf, .svg, .png or .gp, but the file name is \"a.jpg\"");
}

}  // namespace test_script_cells
