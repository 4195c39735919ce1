// The program as a user meets it when something is wrong: what it says, its exit code, and that nothing half-written
// stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/languages.h"
#include "base/reader.h"
#include "data_io/values/command_messages.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_program_errors {
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

TEST(program_errors, script_that_fails_gives_the_report_up_to_there_and_its_error) {
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
    EXPECT_THAT(report, ContainsRegex("\nbefore\n(.|\n)*on purpose(.|\n)*the cells below were not run(.|\n)*print"));
    EXPECT_THAT(report, Not(HasSubstr("\nafter\n")));
    EXPECT_THAT(report, HasSubstr("**\\[fit\\]**"));
}

TEST(program_errors, script_that_fails_is_reported_even_where_no_report_can_be_made) {
    const Workbench bench;
    write_folder(bench, "error('on purpose')\n", "![A](absent.png)\n");
    const ChildResult result = bench.dynlab({"report", "mine"});
    expect_failure(result, 1, "on purpose\n    error('on purpose')\nThe report up to this point cannot be created: ");
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
}

// oracle: the messages that the same command prints
TEST(program_errors, messages_go_to_the_program_that_asks_for_them) {
    const Workbench bench;
    write_folder(bench, "-- %%\nlocal x = y\n", "::: {.cells}\n:::\n");
    const ChildResult result = bench.shell("DYNLAB_MESSAGES=said \"$DYNLAB\" report mine -o out.md");
    const CommandMessages said = read_command_messages(bench.path("said"));
    EXPECT_EQ(said.results, std::vector{Message("{} (up to the error)", bench.path("out.md").string())});
    ASSERT_EQ(said.complaints.size(), 1u);
    EXPECT_EQ("dynlab: " + message_text(said.complaints.front()) + "\n", result.error_output);
    EXPECT_THAT(message_text(said.complaints.front(), {catalog_of("fr")}),
                HasSubstr("analysis.lua:2: fonction ou variable inconnue"));
    EXPECT_TRUE(said.notes.empty());
    bench.shell("DYNLAB_MESSAGES=said \"$DYNLAB\" report nowhere");
    EXPECT_THAT(message_text(read_command_messages(bench.path("said")).all()), HasSubstr("nowhere"));
}

TEST(program_errors, control_c_ends_an_endless_loop_and_leaves_nothing) {
    const Workbench bench;
    write_folder(bench, "while true do pcall(function() while true do end end) end\n", "::: {.cells}\n:::\n");
    // The loop has begun when the program has used far more processor time (hundredths of a second) than a start takes.
    const ChildResult result = bench.shell(
        "\"$DYNLAB\" report mine & until [ \"$(cut -d ' ' -f 14 /proc/$!/stat)\" -ge 30 ] || ! kill -0 $!; do\n"
        "sleep 0.02; done; kill -INT $!; wait $!");
    expect_failure(result, 130, "interrupted");
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
}

TEST(program_errors, characters_that_no_font_has_are_named_and_replaced) {
    const Workbench bench;
    write_folder(bench, "print(1)\n", "A shaking face: \xF0\x9F\xAB\xA8\n");
    const ChildResult made = bench.dynlab({"report", "mine"});
    EXPECT_EQ(made.exit_code, 0) << made.error_output;
    EXPECT_THAT(made.error_output, HasSubstr("mine/report.md:5: no installed font has the following letters"));
    EXPECT_THAT(made.error_output, HasSubstr("U+1FAE8"));
}

TEST(program_errors, latex_failure_reports_the_first_real_error) {
    const Workbench bench;
    write_folder(bench, "print(1)\n", "# Results\n\n$$ x^1^2 $$\n");
    const ChildResult result = bench.dynlab({"report", "mine"});
    expect_failure(result, 1, "Double superscript");
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
}

TEST(program_errors, output_that_cannot_be_written_is_named) {
    const Workbench bench;
    bench.write("a_file", "x");
    write_folder(bench, "print(1)\n", "Text.\n");
    expect_failure(bench.dynlab({"report", "mine", "-o", "a_file/report.pdf"}), 1, "cannot write report.pdf");
    expect_failure(bench.dynlab({"report", "mine", "-o", "report.docx"}), 1, ".pdf");
}

TEST(program_errors, printing_into_a_full_device_is_reported) {
    const Workbench bench;
    for (const char* words : {"help", "help srivc", "--help", "lessons", "run -e 'print(1)'",
                              "run -e 'for i = 1, 1e4 do print(i) end'", "run -e 'report.value(\"a\", 1)'"}) {
        const ChildResult result = bench.shell("\"$DYNLAB\" " + std::string(words) + " > /dev/full");
        expect_failure(result, 1, "dynlab: cannot write the output: no space left on device");
    }
    EXPECT_EQ(bench.shell("\"$DYNLAB\" help > /dev/null").exit_code, 0);
}

TEST(program_errors, full_disk_leaves_the_old_report) {
    const Workbench bench;
    write_folder(bench, "print(1)\n", "Text.\n");
    // A file system of 16 KiB in a separate mount namespace; the PDF needs more.
    const ChildResult result = bench.shell(
        "mkdir disk; unshare --mount --map-root-user bash -c '"
        "mount -t tmpfs -o size=16k tmpfs disk && echo old > disk/report.pdf; "
        "\"$DYNLAB\" report mine -o disk/report.pdf; code=$?; ls -A disk; cat disk/report.pdf; exit $code'");
    expect_failure(result, 1, "cannot write report.pdf");
    EXPECT_THAT(result.error_output, HasSubstr("o space left"));
    EXPECT_EQ(result.output, "report.pdf\nold\n");
}

TEST(program_errors, missing_programs_are_reported_with_the_package) {
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

// The messages themselves: tests/unit/cli/test_usage_message.cpp and tests/unit/workflow/test_given_script.cpp.
TEST(program_errors, wrong_words_are_reported_in_all_programs_and_nothing_is_written) {
    const Workbench bench;
    write_folder(bench, "-- %%\nprint(1)\n", "Text\n");
    bench.write("mine/report.pdf", "%PDF the good one");
    bench.write("capital/Analysis.lua", "print(1)\n");
    expect_failure(bench.dynlab({"run"}), 2, "a script FILE or -e CODE");
    expect_failure(bench.dynlab({"raport", "mine"}), 2,
                   "dynlab: unknown command 'raport'; did you mean 'report'?\nFor more information, run dynlab --help");
    expect_failure(bench.dynlab({"course", "statu", "here"}), 2,
                   "dynlab: dynlab course has no command 'statu'; did you mean 'status'?\n");
    for (const std::string command : {"report", "check"})
        expect_failure(
            bench.dynlab({command, "mine/report.md"}), 2,
            "dynlab: report.md is the report's text. Give the folder, for example: dynlab " + command + " mine\n");
    expect_failure(bench.dynlab({"run", "absent.lua"}), 1, "absent.lua");
    expect_failure(bench.dynlab({"report", "miner"}), 1, "unknown lesson or folder 'miner'; did you mean 'mine'?\n");
    bench.write("mine.lua", "print(1)\n");
    for (const std::string command : {"run", "report", "preview"})
        expect_failure(bench.dynlab({command, "minr.lua"}), 1, "file not found: minr.lua; did you mean mine.lua?\n");
    for (const std::string command : {"lint", "pack", "check"})
        expect_failure(bench.dynlab({command, "minr.lua"}), 2, "file not found: minr.lua; did you mean mine.lua?\n");
    expect_failure(bench.dynlab({"hint", "mine.lua"}), 1,
                   "'mine.lua' is a file; give the number, the name or the folder of a lesson. The lessons are ");
    expect_failure(bench.dynlab({"check", "miner"}), 2, "file or folder not found: miner; did you mean mine?\n");
    expect_failure(bench.dynlab({"lint", "capital"}), 2,
                   "missing from the folder capital, but there is Analysis.lua: rename it");
    EXPECT_EQ(bench.read("mine/report.pdf"), "%PDF the good one");
    EXPECT_THAT(bench.files(), ElementsAre("capital", "mine", "mine.lua"));
}

TEST(program_errors, a_bibliography_that_is_a_link_to_elsewhere_is_not_packed) {
    const Workbench bench;
    bench.write("outside.bib", "@book{secret, author={Outsider, O.}, title={A secret}, year={2020}}\n");
    bench.write("mine/analysis.lua",
                "-- ---\n-- bibliography: link.bib\n-- ---\n-- %% [markdown]\n-- As in @secret.\n");
    std::filesystem::create_symlink("../outside.bib", bench.path("mine/link.bib"));
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"pack", "mine/analysis.lua"}, {"weave", "mine/analysis.lua", "-o", "mine.html"}})
        expect_failure(bench.dynlab(words), 1, "link.bib: the bibliography is outside the folder of the document");
    EXPECT_THAT(bench.files(), ElementsAre("mine", "outside.bib"));
}

TEST(program_errors, lint_reads_notebooks_and_names_their_cells) {
    const Workbench bench;
    bench.write("a.lua", "-- %%\nx = 1\n\n-- %%\nprint(x)\nprint(meen(x))\n");
    ASSERT_EQ(bench.dynlab({"notebook", "a.lua"}).exit_code, 0);
    const ChildResult found = bench.dynlab({"lint", "a.ipynb"});
    EXPECT_EQ(found.exit_code, 1);
    EXPECT_THAT(found.output, testing::StartsWith("a.ipynb, cell 2, line 2: "));
    EXPECT_THAT(found.output, HasSubstr("meen"));
}

TEST(program_errors, a_folder_that_cannot_be_made_is_reported_as_other_files_are) {
    const Workbench bench;
    bench.write("block", "a file");
    expect_failure(bench.dynlab({"run", "-e", "print(1)", "--out", "block/out"}), 1,
                   "dynlab: cannot create the folder block/out: not a directory\n");
}

}  // namespace test_program_errors
}  // namespace dynlab::test
