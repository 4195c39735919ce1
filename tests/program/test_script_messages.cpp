// The messages of `dynlab run` and `dynlab report` about a script: errors with place, line and calls, reported values,
// and results without a place in the text. Oracle: the lines of the scripts, written here by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "support/program.h"

namespace dynlab::test {
namespace test_script_messages {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string reported(const Workbench& bench, const std::string& script, const std::string& code) {
    bench.write(script, code);
    return bench.dynlab({"run", script}).error_output;
}

TEST(script_messages, an_error_shows_the_path_as_given_the_line_and_the_calls) {
    const Workbench bench;
    EXPECT_EQ(reported(bench, "A/a.lua", "local function f(n)\n  return zeros(n)\nend\nf('x')\n"),
              "dynlab: A/a.lua:2: zeros: argument 1 (n) must be a number, but the string \"x\" was given\n"
              "    return zeros(n)\n"
              "  A/a.lua:4: called f(n = \"x\")\n"
              "    f('x')\n");
    EXPECT_THAT(bench.shell("cd A && \"$DYNLAB\" run ./a.lua 2>&1").output, HasSubstr("dynlab: ./a.lua:2: "));
    EXPECT_THAT(bench.dynlab({"run", bench.path("A/a.lua").string()}).error_output,
                HasSubstr("dynlab: " + bench.path("A/a.lua").string() + ":2: "));
    EXPECT_EQ(bench.dynlab({"run", "-e", "error('no')"}).error_output, "dynlab: command line:1: no\n    error('no')\n");
}

TEST(script_messages, a_report_has_the_same_messages) {
    const Workbench bench;
    bench.write("A/analysis.lua", "local function f(n)\n  return zeros(n)\nend\nf(-1)\nprint('never')\n");
    bench.write("A/report.md", "---\ntitle: A\n---\n\nText.\n");
    EXPECT_EQ(bench.dynlab({"report", "A", "-o", "a.md"}).error_output,
              "dynlab: A/analysis.lua:2: zeros: argument 1 (n) must be nonnegative, but -1 was given\n    return "
              "zeros(n)\n  A/analysis.lua:4: called f(n = -1)\n    f(-1)\n");
    const auto checked = nlohmann::json::parse(bench.dynlab({"check", "A", "--json"}).output);
    EXPECT_EQ(checked.at("findings").at(0).at("what"),
              "The report cannot be built from a clean copy of the folder: analysis.lua:2: zeros: argument 1 (n) must "
              "be nonnegative, but -1 was given");
}

TEST(script_messages, run_prints_what_is_reported) {
    const Workbench bench;
    bench.write("a.lua",
                "report.value('fit', 93.25, '%.1f')\nreport.table('models', {{'Model', 'Fit'}, {'P1', '93'}})\n"
                "report.text('end', 'It *fits*.')\n");
    const ChildResult run = bench.dynlab({"run", "a.lua"});
    EXPECT_EQ(run.output, "value fit: 93.2\ntable models:\nModel  Fit\n-----  ---\nP1     93\ntext end: It *fits*.\n");
    EXPECT_THAT(run.error_output, IsEmpty());  // a script without text has no reader that misses it
}

TEST(script_messages, run_report_and_check_report_what_has_no_place) {
    const Workbench bench;
    bench.write("A/analysis.lua", "report.value('fit', 93.25, '%.1f')\nreport.value('gain', 2, '%.0f')\n");
    bench.write("A/report.md", "---\ntitle: A\n---\n\nThe fit is `fit`{.value} % of what could be had.\n");
    const std::string note =
        "dynlab: note: the value 'gain' is passed to the report but never shown; write `gain`{.value}\n";
    EXPECT_EQ(bench.dynlab({"run", "A"}).error_output, note);
    EXPECT_EQ(bench.dynlab({"report", "A"}).error_output, note);
    const std::string checked = bench.dynlab({"check", "A"}).output;
    EXPECT_THAT(
        checked,
        HasSubstr(
            "not-shown\n    report.md: In analysis.lua, the value 'gain' is passed to the report but never shown."));
    EXPECT_THAT(checked, HasSubstr("Write `gain`{.value} in the text."));
    bench.write("A/report.md", "---\ntitle: A\n---\n\nThe fit is `fit`{.value} %, the gain `gain`{.value}.\n");
    EXPECT_THAT(bench.dynlab({"run", "A"}).error_output, IsEmpty());
    EXPECT_THAT(bench.dynlab({"check", "A"}).output, Not(HasSubstr("not-shown")));
    // Text of cells counts where the report shows them.
    bench.write("A/analysis.lua", "-- %% [markdown]\n-- `gain`{.value}\n-- %%\nreport.value('gain', 2, '%.0f')\n");
    bench.write("A/report.md", "---\ntitle: A\n---\n\nText.\n");
    EXPECT_EQ(bench.dynlab({"run", "A"}).error_output, note);
    bench.write("A/report.md", "---\ntitle: A\n---\n\n::: {.cells}\n:::\n");
    EXPECT_THAT(bench.dynlab({"run", "A"}).error_output, IsEmpty());
}

TEST(script_messages, check_reports_that_nobody_is_named) {
    const Workbench bench;
    bench.write("A/analysis.lua", "print(1)\n");
    bench.write("A/report.md", "---\ntitle: A\n---\n\nText.\n");
    bench.write("A/group.toml", "members = []\nseed = 1\n");
    EXPECT_THAT(bench.dynlab({"check", "A"}).output, HasSubstr("members-missing\n    group.toml: No members"));
    bench.write("A/group.toml", "members = [\"Ada Lovelace\"]\nseed = 1\n");
    EXPECT_THAT(bench.dynlab({"check", "A"}).output, Not(HasSubstr("members-missing")));
}

TEST(script_messages, files_of_a_run_lie_beside_its_script) {
    const Workbench bench;
    bench.write("A/analysis.lua", "plot({1, 2})\nplot({1, 3})\nsave_csv('r.csv', {x = vector{1, 2}})\n");
    bench.write("B/analysis.lua", "plot({1, 2})\n");
    bench.write("A/report.md", "---\ntitle: A\n---\n\nText.\n");
    const std::string first = "figure cell-1-figure-1: A/analysis_out/01-cell-1-figure-1.pdf\n";
    EXPECT_EQ(bench.dynlab({"run", "A/analysis.lua"}).output,
              first + "figure cell-1-figure-2: A/analysis_out/02-cell-1-figure-2.pdf\n");
    ASSERT_EQ(bench.dynlab({"run", "B"}).exit_code, 0);
    EXPECT_THAT(bench.files(), ElementsAre("A", "B"));
    EXPECT_TRUE(std::filesystem::exists(bench.path("A/r.csv")));
    // A figure that the script no longer makes is removed. The user's files stay.
    bench.write("A/analysis_out/notes.txt", "mine");
    bench.write("A/analysis.lua", "plot({1, 2})\n");
    EXPECT_EQ(bench.dynlab({"run", "A"}).output, first);
    EXPECT_EQ(bench.shell("ls A/analysis_out").output, "01-cell-1-figure-1.pdf\nnotes.txt\n");
    EXPECT_EQ(bench.dynlab({"report", "A"}).output, bench.path("A/report.pdf").string() + "\n");
    const ChildResult packed = bench.dynlab({"pack", "A"});
    EXPECT_THAT(packed.output, HasSubstr("report.pdf\n"));
    EXPECT_THAT(packed.output, Not(HasSubstr("analysis_out")));
    EXPECT_THAT(packed.error_output, IsEmpty());
}

TEST(script_messages, a_reference_to_nothing_leaves_a_draft) {
    const Workbench bench;
    const std::string whole = "---\ntitle: A\n---\n\nThe gain.\n";
    bench.write("A/analysis.lua", "print(1)\n");
    bench.write("A/report.md", whole + "\nAs @fig:step shows, `gain`{.value} s.\n");
    const ChildResult draft = bench.dynlab({"report", "A"});
    EXPECT_EQ(draft.exit_code, 1);
    EXPECT_THAT(draft.output, HasSubstr("report.pdf (draft: \"??\" marks the missing parts)"));
    EXPECT_THAT(draft.error_output, HasSubstr("A/report.md:7: the cross-reference @fig:step has no target"));
    EXPECT_THAT(draft.error_output, HasSubstr("A/report.md:7: the script reported no value \"gain\""));
    EXPECT_THAT(bench.shell("pdftotext A/report.pdf -").output, HasSubstr("As ?? shows, ?? s."));
    EXPECT_THAT(bench.dynlab({"pack", "A"}).error_output,
                HasSubstr("report.pdf is a draft and contains \"??\"; to list"));
    const ChildResult checked = bench.dynlab({"check", "A"});
    EXPECT_EQ(checked.exit_code, 1);
    EXPECT_THAT(checked.output, HasSubstr("analysis-fails"));
    EXPECT_THAT(std::regex_replace(checked.output, std::regex("\\s+"), " "),
                HasSubstr("the cross-reference @fig:step has no target"));
    // French puts spaces before question marks, but not between these.
    bench.write("A/report.md", "---\ntitle: A\nlang: fr\n---\n\nPar k=`gain`{.value}m, ou `gain`{.value}%.\n");
    EXPECT_THAT(bench.dynlab({"report", "A"}).error_output, HasSubstr("A/report.md:6: le script n'a"));
    EXPECT_THAT(bench.shell("pdftotext A/report.pdf -").output, HasSubstr("Par k=??m, ou ??"));
    EXPECT_THAT(bench.dynlab({"pack", "A"}).error_output, HasSubstr("report.pdf est un brouillon"));
    bench.write("A/report.md", whole + "\n**Why??** Who knows, and `a ?? b` is code.\n");
    ASSERT_EQ(bench.dynlab({"report", "A"}).exit_code, 0);
    EXPECT_THAT(bench.dynlab({"pack", "A"}).error_output, IsEmpty());
}

}  // namespace test_script_messages
}  // namespace dynlab::test
