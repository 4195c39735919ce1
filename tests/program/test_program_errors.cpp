// The program as a user meets it when something is wrong: what it says, its exit code, and that nothing half-written
// stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"

namespace dynlab::test {
namespace test_bad_input {
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kReportHeader = "---\ntitle: A report\n---\n\n";

/// A folder as `dynlab new` makes it, with this analysis and this text.
void write_folder(const Workbench& bench, const std::string& analysis, const std::string& report) {
    bench.write("mine/analysis.lua", analysis);
    bench.write("mine/report.md", kReportHeader + report);
}

void expect_failure(const ChildResult& result, int code, const std::string& part) {
    EXPECT_EQ(result.exit_code, code) << result.output << result.error_output;
    EXPECT_THAT(result.error_output, HasSubstr(part));
    EXPECT_THAT(result.error_output, Not(HasSubstr("terminate called")));
}

TEST(bad_input, unknown_data_name_suggests_the_nearest) {
    const Workbench bench;
    bench.write("a.lua", "\nlocal d = load('winning_tmies')\n");
    const ChildResult result = bench.dynlab({"run", "a.lua"});
    expect_failure(result, 1, "a.lua:2");
    EXPECT_THAT(result.error_output, HasSubstr("winning_times"));
}

TEST(bad_input, broken_data_files_are_named) {
    const Workbench bench;
    bench.write("cut.mat", std::string("MATLAB 5.0 MAT-file").append(140, ' '));
    bench.write("ragged.csv", "t,y\n0,1\n1\n");
    bench.write("word.csv", "t,y\n0,1\n1,two\n");
    bench.write("inf.csv", "t,y\n0,1\n1,Inf\n");
    expect_failure(bench.dynlab({"run", "-e", "load('cut.mat')"}), 1, "cut.mat");
    expect_failure(bench.dynlab({"run", "-e", "load('ragged.csv')"}), 1, "ragged.csv, line 3");
    expect_failure(bench.dynlab({"run", "-e", "load('word.csv')"}), 1, "word.csv, line 3");
    expect_failure(bench.dynlab({"run", "-e", "load('inf.csv')"}), 1, "inf.csv, line 3");
    expect_failure(bench.dynlab({"run", "-e", "load('nowhere.mat')"}), 1, "nowhere.mat");
}

TEST(bad_input, vectors_of_different_lengths_are_told_with_both_lengths) {
    const Workbench bench;
    const ChildResult result = bench.dynlab({"run", "-e", "iddata(zeros(3), zeros(4), 1)"});
    expect_failure(result, 1, "3");
    EXPECT_THAT(result.error_output, HasSubstr("4"));
}

TEST(bad_input, records_of_no_use_are_told_in_words) {
    const Workbench bench;
    bench.write("wrong.csv", "t,in,out\n0,1,2\n0.1,2,3\n0.2,3,4\n");
    bench.write("uneven.csv", "t,u,y\n0,1,2\n0.1,2,3\n0.3,3,4\n0.31,1,2\n0.5,1,2\n");
    const std::string crane = "local e = load('crane').estimation ";
    const std::pair<std::string, std::string> refused[] = {
        {"local d = load('wrong.csv') iddata(d.y, d.u, 0.1)", "'wrong.csv' have no variable 'y'; they have in, out, t"},
        {"local d = load('uneven.csv') iddata(d.y, d.u, d.t)", "{SamplingInstants = t}"},
        {"local d = load('uneven.csv') arx(iddata(d.y, d.u, nil, {SamplingInstants = d.t}), {1, 1, 1})", "regular"},
        {"local u = prbs(6, 4) merge(iddata(u, u, 0.1), iddata(u, u, 0.2))",
         "sampling time 0.2 s but the first has 0.1 s"},
        {"local u = prbs(6, 4) arx(iddata(ones(#u), u, 0.1), {1, 1, 1})", "the output never changes"},
        {"srivc(iddata({0, 1, 0.5, 0.2, 1}, {1, 0, 0, 1, 0}, 0.1), {2, 2, 0})", "at least 12 samples are needed"},
        {crane + "iddata(e, 0.02)", "the table holds t, theta, u, x"},
    };
    for (const auto& [code, words] : refused) expect_failure(bench.dynlab({"run", "-e", code}), 1, words);
    expect_failure(bench.dynlab({"identify", "wrong.csv", "--input", "u", "--output", "y", "--poles", "1"}), 1,
                   "there are in, out, t");
    const std::pair<std::string, std::string> advised[] = {
        {crane + "advice(iddata(e.theta*180/math.pi, e.u, 0.02, {OutputUnit = 'rad'}))", "probably in degrees"},
        {crane + "advice(iddata(e.u, e.theta, 0.02))", "probably exchanged"},
        {crane + "advice(iddata(ones(#e.u), e.u, 0.02))", "stays at 1 throughout"},
        {"local u = prbs(6, 8) local y = lsim(tf({100}, {1, 1}), u, 0.05) for k = 1, #y do y[k] = math.max(-1, "
         "math.min(1, y[k])) end advice(iddata(y, u, 0.05))",
         "Most of the record is saturated"},
    };
    for (const auto& [code, words] : advised) {
        const ChildResult result = bench.dynlab({"run", "-e", code});
        EXPECT_EQ(result.exit_code, 0) << result.error_output;
        EXPECT_THAT(result.output, HasSubstr(words)) << code;
    }
}

TEST(bad_input, syntax_and_runtime_errors_have_file_and_line) {
    const Workbench bench;
    bench.write("syntax.lua", "local a = 1\nlocal b = = 2\n");
    bench.write("runtime.lua", "local a\n\nprint(a.x)\n");
    expect_failure(bench.dynlab({"run", "syntax.lua"}), 1, "syntax.lua:2");
    expect_failure(bench.dynlab({"run", "runtime.lua"}), 1, "runtime.lua:3");
    expect_failure(bench.dynlab({"run", "absent.lua"}), 1, "absent.lua");
}

TEST(bad_input, script_that_fails_gives_the_report_up_to_there_and_its_error) {
    const Workbench bench;
    write_folder(bench, "-- %%\nprint('before')\n-- %%\nerror('on purpose')\n-- %%\nprint('after')\n",
                 "::: {.cells}\n:::\n\nFit `fit`{.value}\n");
    const std::vector<std::string> make = {"report", "mine", "-o", "out.md"};
    for (int repeat = 0; repeat < 2; ++repeat) {  // such a report is never up to date
        const ChildResult result = bench.dynlab(make);
        expect_failure(result, 1, "analysis.lua:4: on purpose");
        EXPECT_THAT(result.output, HasSubstr("out.md (up to the error)"));
    }
    const std::string report = bench.read("out.md");
    EXPECT_THAT(report, ContainsRegex("\nbefore\n(.|\n)*on purpose(.|\n)*nothing below was run(.|\n)*print"));
    EXPECT_THAT(report, Not(HasSubstr("\nafter\n")));
    EXPECT_THAT(report, HasSubstr("**\\[fit\\]**"));
}

TEST(bad_input, script_that_fails_is_told_even_where_no_report_can_be_made) {
    const Workbench bench;
    write_folder(bench, "error('on purpose')\n", "![A](absent.png)\n");
    const ChildResult result = bench.dynlab({"report", "mine"});
    expect_failure(result, 1, "on purpose\n    error('on purpose')\nThe report up to there cannot be made: ");
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
}

TEST(bad_input, control_c_ends_an_endless_loop_and_leaves_nothing) {
    const Workbench bench;
    write_folder(bench, "while true do pcall(function() while true do end end) end\n", "::: {.cells}\n:::\n");
    // Not before the program catches SIGINT, the second bit of SigCgt; half a second later the loop has begun.
    const ChildResult result = bench.shell(
        "\"$DYNLAB\" report mine & until grep -q 'SigCgt:.*[2367abef]$' /proc/$!/status || ! kill -0 $!; do\n"
        "sleep 0.02; done; sleep 0.5; kill -INT $!; wait $!");
    expect_failure(result, 130, "interrupted");
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
}

TEST(bad_input, slot_without_entry_names_slot_file_and_line) {
    const Workbench bench;
    write_folder(bench, "report.value('fit', 93.2, '%.1f')\n", "The fit is `fti`{.value} %.\n");
    const ChildResult result = bench.dynlab({"report", "mine"});
    expect_failure(result, 1, "report.md:5");
    EXPECT_THAT(result.error_output, HasSubstr("fti"));
    EXPECT_THAT(result.error_output, HasSubstr("fit"));
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
}

TEST(bad_input, missing_figures_are_errors) {
    const Workbench bench;
    write_folder(bench, "print(1)\n", "![A](figure:raw){#fig:raw}\n\n![B](picture.png)\n");
    const ChildResult result = bench.dynlab({"report", "mine"});
    expect_failure(result, 1, "raw");
    EXPECT_THAT(result.error_output, HasSubstr("picture.png"));
}

TEST(bad_input, characters_latex_cannot_print_are_named) {
    const Workbench bench;
    write_folder(bench, "print(1)\n", "A cat: \xF0\x9F\x90\x88\n");
    expect_failure(bench.dynlab({"report", "mine"}), 1, "U+1F408");
}

TEST(bad_input, latex_failure_tells_the_first_real_error) {
    const Workbench bench;
    write_folder(bench, "print(1)\n", "# Results\n\n$$ x^1^2 $$\n");
    const ChildResult result = bench.dynlab({"report", "mine"});
    expect_failure(result, 1, "Double superscript");
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
}

TEST(bad_input, output_that_cannot_be_written_is_named) {
    const Workbench bench;
    bench.write("a_file", "x");
    write_folder(bench, "print(1)\n", "Text.\n");
    expect_failure(bench.dynlab({"report", "mine", "-o", "a_file/report.pdf"}), 1, "cannot write report.pdf");
    expect_failure(bench.dynlab({"report", "mine", "-o", "report.docx"}), 1, ".pdf");
}

TEST(bad_input, full_disk_leaves_the_old_report) {
    const Workbench bench;
    write_folder(bench, "print(1)\n", "Text.\n");
    // A file system of 16 KiB in a mount namespace of its own; the PDF needs more.
    const ChildResult result = bench.shell(
        "mkdir disk; unshare --mount --map-root-user bash -c '"
        "mount -t tmpfs -o size=16k tmpfs disk && echo old > disk/report.pdf; "
        "\"$DYNLAB\" report mine -o disk/report.pdf; code=$?; ls -A disk; cat disk/report.pdf; exit $code'");
    expect_failure(result, 1, "cannot write report.pdf");
    EXPECT_THAT(result.error_output, HasSubstr("o space left"));
    EXPECT_EQ(result.output, "report.pdf\nold\n");
}

TEST(bad_input, missing_programs_are_told_with_the_package) {
    for (const auto& [program, package] :
         {std::pair{"gnuplot", "gnuplot-nox"}, {"pandoc", "pandoc"}, {"pdflatex", "texlive-latex-base"}}) {
        Workbench bench;
        write_folder(bench, "plot({1, 2}, {3, 4})\n", "::: {.cells}\n:::\n");
        bench.hide_program(program);
        const ChildResult result = bench.dynlab({"report", "mine"});
        expect_failure(result, 3, program);
        EXPECT_THAT(result.error_output, HasSubstr(std::string("sudo apt install ") + package));
        EXPECT_THAT(bench.files(), ElementsAre("mine"));
    }
}

TEST(bad_input, wrong_usage_is_exit_code_two) {
    const Workbench bench;
    EXPECT_EQ(bench.dynlab({"run"}).exit_code, 2);
    EXPECT_EQ(bench.dynlab({"report"}).exit_code, 2);
    EXPECT_EQ(bench.dynlab({"frobnicate"}).exit_code, 2);
    EXPECT_EQ(bench.dynlab({"run", "-e", "print(1)", "--seed", "many"}).exit_code, 2);
    EXPECT_EQ(bench.dynlab({"run", "-e", "print(1)", "--seed", "-1"}).exit_code, 2);
}

TEST(bad_input, unknown_lesson_lists_the_lessons) {
    const Workbench bench;
    const ChildResult result = bench.dynlab({"report", "77"});
    expect_failure(result, 1, "02_least_squares");
}

TEST(bad_input, group_file_errors_are_told) {
    const Workbench bench;
    write_folder(bench, "print(1)\n", "Text.\n");
    bench.write("mine/group.toml", "seed = -3\n");
    expect_failure(bench.dynlab({"report", "mine"}), 1, "group.toml");
    bench.write("mine/group.toml", "\nseed = = 3\n");
    expect_failure(bench.dynlab({"report", "mine"}), 1, "group.toml:2");
}

TEST(bad_input, misspelt_commands_and_options_are_told_in_the_order_given_with_the_nearest) {
    const Workbench bench;
    expect_failure(bench.dynlab({"raport", "my-work"}), 2,
                   "dynlab: there is no command 'raport'; did you mean 'report'?\nRun with --help");
    expect_failure(bench.dynlab({"course", "statu", "here"}), 2,
                   "dynlab: dynlab course has no command 'statu'; did you mean 'status'?\n");
    expect_failure(bench.dynlab({"report", "02", "--outputt", "a.pdf"}), 2,
                   "dynlab: dynlab report has no option '--outputt'; did you mean '--output'?\n");
    expect_failure(bench.dynlab({"xyzzy", "a"}), 2, "dynlab: there is no command 'xyzzy'\n");
    expect_failure(bench.dynlab({"report", "a", "b", "c"}), 2, "dynlab: nothing is known of b c here\n");
    EXPECT_THAT(bench.files(), ElementsAre());
}

TEST(bad_input, a_bibliography_that_is_a_link_to_elsewhere_is_not_packed) {
    const Workbench bench;
    bench.write("outside.bib", "@book{secret, author={Outsider, O.}, title={A secret}, year={2020}}\n");
    bench.write("mine/analysis.lua",
                "-- ---\n-- bibliography: link.bib\n-- ---\n-- %% [markdown]\n-- As in @secret.\n");
    std::filesystem::create_symlink("../outside.bib", bench.path("mine/link.bib"));
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"pack", "mine/analysis.lua"}, {"weave", "mine/analysis.lua", "-o", "mine.html"}})
        expect_failure(bench.dynlab(words), 1, "link.bib: the bibliography lies outside the folder of this file");
    EXPECT_THAT(bench.files(), ElementsAre("mine", "outside.bib"));
}

TEST(bad_input, files_that_are_no_script_are_told_and_nothing_is_written) {
    const Workbench bench;
    write_folder(bench, "-- %%\nprint(1)\n", "Text\n");
    bench.write("mine/report.pdf", "%PDF the good one");
    bench.write("data.csv", "t,y\n0,1\n");
    for (const std::string command : {"report", "run", "lint", "pack", "check"})
        expect_failure(bench.dynlab({command, "mine/report.md"}), 2,
                       "dynlab: report.md is the report's text: give the folder, dynlab " + command + " mine\n");
    expect_failure(bench.dynlab({"weave", "mine/report.pdf", "-o", "a.html"}), 2,
                   "report.pdf is the report's PDF: give the folder, dynlab weave mine\n");
    for (const std::string command : {"report", "run", "lint"})
        expect_failure(bench.dynlab({command, "data.csv"}), 2,
                       "data.csv is a table of data: give a script (.lua) or a notebook (.ipynb)\n");
    EXPECT_EQ(bench.read("mine/report.pdf"), "%PDF the good one");
    EXPECT_THAT(bench.files(), ElementsAre("data.csv", "mine"));
}

TEST(bad_input, what_is_nearly_called_so_is_named) {
    const Workbench bench;
    bench.write("capital/Analysis.lua", "print(1)\n");
    bench.write("second/analysis (2).lua", "print(1)\n");
    bench.write("text/analysis.lua", "print(1)\n");
    bench.write("text/Report.md", "Text\n");
    bench.write("my-work/analysis.lua", "print(1)\n");
    expect_failure(bench.dynlab({"run", "capital"}), 1,
                   "there is no analysis.lua in the folder capital, but Analysis.lua: call it analysis.lua");
    expect_failure(bench.dynlab({"lint", "second"}), 2, "in the folder second, but analysis (2).lua: call it");
    expect_failure(bench.dynlab({"report", "capital"}), 1, "capital has no analysis.lua, but Analysis.lua: call it");
    expect_failure(bench.dynlab({"report", "text"}), 1, "text has no report.md, but Report.md: call it report.md");
    expect_failure(bench.dynlab({"report", "my-wrok"}), 1,
                   "there is no lesson or folder 'my-wrok'; did you mean 'my-work'? the lessons are ");
    expect_failure(bench.dynlab({"hint", "capital"}), 1,
                   "the folder 'capital' holds no lesson.lua and no analysis.lua, but Analysis.lua: call it");
    expect_failure(bench.dynlab({"hint", "."}), 1,
                   "the folder '.' holds no lesson.lua and no analysis.lua; the lessons");
}

TEST(bad_input, lint_reads_notebooks_and_names_their_cells) {
    const Workbench bench;
    bench.write("a.lua", "-- %%\nx = 1\n\n-- %%\nprint(x)\nprint(meen(x))\n");
    ASSERT_EQ(bench.dynlab({"notebook", "a.lua"}).exit_code, 0);
    const ChildResult found = bench.dynlab({"lint", "a.ipynb"});
    EXPECT_EQ(found.exit_code, 1);
    EXPECT_THAT(found.output, testing::StartsWith("a.ipynb, cell 2, line 2: "));
    EXPECT_THAT(found.output, HasSubstr("meen"));
}

TEST(bad_input, a_folder_that_cannot_be_made_is_told_as_other_files_are) {
    const Workbench bench;
    bench.write("block", "a file");
    expect_failure(bench.dynlab({"run", "-e", "print(1)", "--out", "block/out"}), 1,
                   "dynlab: cannot make the folder block/out: not a directory\n");
}

}  // namespace test_bad_input
}  // namespace dynlab::test
