// `dynlab check` as it is typed. Oracles: the exit codes of its help, the defects put in, and the files in the folder
// before and after.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/reader.h"
#include "course/grading/folder_check.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_check_command {
using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kAnalysis = "report.value('sum', sum(load('values.csv').y), '%.0f')\n";
constexpr const char* kReport =
    "---\ntitle: A\npages: 1\n---\n\nThe sum of the values is `sum`{.value}, and it is the one that was to be found "
    "from "
    "the file which lies beside the analysis.\n";

/// A student's folder `mine` in which all is well.
void make_folder(const Workbench& bench, const std::string& analysis = kAnalysis, const std::string& report = kReport) {
    bench.write("mine/values.csv", "y\n1\n2\n");
    bench.write("mine/analysis.lua", analysis);
    bench.write("mine/report.md", report);
}

std::string listing(const Workbench& bench) {
    return bench.shell("cd mine && find . -printf '%p %s %T@\\n' | sort").output;
}

TEST(check_command, a_sound_folder_passes_with_one_line_and_is_left_as_it_was) {
    const Workbench bench;
    make_folder(bench);
    const std::string before = listing(bench);
    const ChildResult result = bench.dynlab({"check", "mine"});
    EXPECT_EQ(result.exit_code, 0) << result.error_output;
    EXPECT_EQ(result.output,
              "mine: nothing to fix; checked: run from a clean copy, 1 page (limit: 1), 0 numbered figures, "
              "placeholder text, English only, text size and margins.\n");
    EXPECT_THAT(result.error_output, IsEmpty());
    EXPECT_EQ(listing(bench), before);
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
}

TEST(check_command, script_without_code_is_reported_and_its_pdf_has_the_name_of_the_script) {
    const Workbench bench;
    bench.write("empty.lua", "-- a comment\n\n");
    const ChildResult empty = bench.dynlab({"check", "empty.lua"});
    EXPECT_EQ(empty.exit_code, 0) << empty.error_output;
    EXPECT_THAT(empty.output,
                HasSubstr("script-empty\n    empty.lua: The script contains no code, so it computes nothing."));
    bench.write("full.lua", "print(1)\n");
    ASSERT_EQ(bench.dynlab({"report", "full.lua"}).exit_code, 0);
    const ChildResult full = bench.dynlab({"check", "full.lua"});
    EXPECT_THAT(full.output, HasSubstr("full.lua: nothing to fix; checked as lesson: run from a clean copy, "));
    EXPECT_THAT(full.output, HasSubstr("full.pdf is up to date"));
    EXPECT_THAT(full.output, Not(HasSubstr("report.pdf")));
}

TEST(check_command, what_needs_more_than_the_folder_fails_from_a_clean_copy) {
    const Workbench bench;
    make_folder(bench);
    std::filesystem::remove(bench.path("mine/values.csv"));
    bench.write("elsewhere.csv", "y\n1\n");
    std::filesystem::create_symlink(bench.path("elsewhere.csv"), bench.path("mine/values.csv"));
    const ChildResult result = bench.dynlab({"check", "mine"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.output, HasSubstr("analysis-fails"));
    EXPECT_THAT(result.output, HasSubstr("analysis.lua:1:"));
    EXPECT_THAT(result.output, HasSubstr("link-left-out\n    values.csv: "));
    EXPECT_THAT(result.output, Not(HasSubstr("/folder/")));
}

// Field case 03 and its like. Oracle: what the script names lies beside it.
TEST(check_command, what_a_script_outside_a_folder_names_goes_with_it) {
    const Workbench bench;
    bench.shell(
        "gnuplot -e \"set terminal jpeg size 90,60; set output 'rig.jpg'; plot x\"; mkdir -p img/deep records lib;"
        "cp rig.jpg 'my rig.jpg'; cp rig.jpg img/deep/Übersicht.jpg; cp rig.jpg a_b.jpg; cp rig.jpg 'b (1).jpg'; "
        "cp rig.jpg r.jpg; cp rig.jpg by_script.jpg");
    bench.write("records/d.csv", "y\n1\n2\n");
    bench.write("bare.csv", "y\n1\n2\n");
    bench.write("lib/tools.lua", "return {two = 2}\n");
    bench.write("work.lua",
                "-- %% [markdown]\n-- # The rig\n-- ![The rig](rig.jpg){#fig:rig}\n--\n-- See @fig:rig.\n--\n"
                "-- ![A](my rig.jpg)\n--\n-- ![B](img/deep/Übersicht.jpg \"Title\")\n--\n-- ![C](a\\_b.jpg)\n--\n"
                "-- ![D](b (1).jpg)\n--\n-- ![E][r]\n--\n-- [r]: r.jpg\n--\n-- ![F](<my rig.jpg>)\n--\n"
                "-- ::: {.text name=t}\n-- :::\n\n-- %%\nlocal tools = require(\"lib.tools\")\n"
                "report.text(\"t\", \"![G](by_script.jpg)\")\n"
                "print(load(\"records/d.csv\").y[1] + load(\"bare\").y[1] + tools.two)\n");
    const ChildResult result = bench.dynlab({"check", "work.lua"});
    EXPECT_THAT(result.output, AllOf(Not(HasSubstr("analysis-fails")), Not(HasSubstr("/box/"))));
    const ChildResult packed = bench.dynlab({"pack", "work.lua", "-o", "work.zip"});
    EXPECT_EQ(packed.exit_code, 0) << packed.error_output;
    const std::string names = bench.shell("unzip -Z1 work.zip").output;
    for (const char* name : {"rig.jpg", "my rig.jpg", "a_b.jpg", "b (1).jpg", "r.jpg", "by_script.jpg", "records/d.csv",
                             "bare.csv", "lib/tools.lua"})
        EXPECT_THAT(names, HasSubstr(name));
    bench.write("gone.lua", "-- %% [markdown]\n-- # A\n-- ![The rig](none.jpg)\n\n-- %%\nprint(1)\n");
    const std::string reported = bench.dynlab({"check", "gone.lua"}).output;
    EXPECT_THAT(reported, AllOf(HasSubstr("the picture \"none.jpg\"\n    is not in the folder"),
                                HasSubstr("of this file"), Not(HasSubstr("/box/"))));
}

// Field case 17: a pasted picture is a gap of the report, not the end of it.
TEST(check_command, a_picture_that_was_pasted_into_a_notebook_is_reported_with_the_remedy) {
    const Workbench bench;
    bench.write(
        "pasted.ipynb",
        R"json({"cells": [{"cell_type": "markdown", "id": "a", "metadata": {}, "source": ["# Rig\n", "![image.png](attachment:image.png)"],
 "attachments": {
        "image.png" : {
            "image/png" : "iVBORw0KGgo="
        }}
}, {"cell_type": "code", "id": "c", "metadata": {}, "outputs": [],
 "execution_count": null, "source": ["print(1)"]}], "metadata": {}, "nbformat": 4, "nbformat_minor": 5
})json");
    const std::string reported = bench.dynlab({"check", "pasted.ipynb"}).output;
    EXPECT_THAT(reported, AllOf(HasSubstr("was pasted into the notebook"),
                                ContainsRegex("Save[[:space:]]+the picture as a file"), Not(HasSubstr("/box/"))));
}

TEST(check_command, a_copied_cell_and_lost_stars_are_hints) {
    const Workbench bench;
    make_folder(bench, std::string("-- %% id=one\n") + kAnalysis + "\n-- %% id=one\nprint(1)\n",
                std::string(kReport) + "\nThe product 2*3*4 = 24, but not $2*3*4$, `2*3*4` or *2*.\n");
    const ChildResult result = bench.dynlab({"check", "mine"});
    EXPECT_THAT(result.output,
                AllOf(HasSubstr("Another cell already has the id \"one\"."), HasSubstr("analysis.lua:5")));
    EXPECT_THAT(result.output,
                AllOf(HasSubstr("report.md:8"), HasSubstr("\"2*3*4\" is printed without its asterisks")));
}

// oracle: the same call of load that grade refuses, and the content of the file
TEST(check_command, a_file_outside_the_folder_is_reported_with_its_line) {
    const Workbench bench;
    bench.write("roster.csv", "name\n424242\n");
    const std::string absolute = bench.path("roster.csv").string();
    for (const std::string& name : {std::string("../roster.csv"), absolute}) {
        make_folder(bench, std::string(kAnalysis) + "local x = load('" + name + "')\nerror(tostring(x.name[1]))\n");
        const ChildResult result = bench.dynlab({"check", "mine"});
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.output, HasSubstr("file-outside\n    analysis.lua:2: "));
        EXPECT_THAT(result.output, HasSubstr("is outside the folder"));
        EXPECT_THAT(result.output, HasSubstr("Copy the file into the folder and load it by its name."));
        EXPECT_THAT(result.output, Not(HasSubstr("424242")));
        EXPECT_THAT(result.output, Not(HasSubstr("analysis-fails")));
    }
    EXPECT_EQ(bench.dynlab({"report", "mine", "-o", "own.pdf"}).exit_code, 1) << "error(...) was reached";
    EXPECT_THAT(bench.dynlab({"report", "mine", "-o", "own.pdf"}).error_output, HasSubstr("424242"));
}

TEST(check_command, students_without_a_searched_number_are_reported) {
    const Workbench bench;
    make_folder(bench);
    bench.write("short.csv", "id,name\ns1,Ada King\n20214711,Bo Ek\n7,Cy Orr\n");
    EXPECT_THAT(bench.dynlab({"check", "mine", "--roster", "short.csv"}).error_output,
                HasSubstr("short.csv: 2 ids with fewer than 3 letters and digits are not searched for in documents; "
                          "an example is s1"));
    bench.write("long.csv", "id,name\n20214711,Bo Ek\n");
    EXPECT_THAT(bench.dynlab({"check", "mine", "--roster", "long.csv"}).error_output, Not(HasSubstr("long.csv")));
}

// oracle: the folder for temporary files after the signal
TEST(check_command, leaves_nothing_behind_when_it_is_terminated) {
    const Workbench bench;
    make_folder(bench, "while true do end\n");
    const ChildResult ended = bench.shell(
        "mkdir tmp && export TMPDIR=$PWD/tmp && { $DYNLAB check mine & } && "
        "until ls tmp/dynlab-*/made > /dev/null 2>&1; do sleep 0.05; done; ls tmp | wc -l; "
        "kill -TERM $!; wait $!; echo \"status $?\"; ls tmp | wc -l");
    EXPECT_THAT(ended.output, testing::MatchesRegex("[1-9][0-9]*\nstatus 143\n0\n"));
}

TEST(check_command, an_analysis_that_fails_or_never_ends_its_report_is_quoted) {
    const Workbench bench;
    make_folder(bench, "local x = nothing + 1\n");
    EXPECT_THAT(bench.dynlab({"check", "mine"}).output, HasSubstr("nothing"));
    make_folder(bench, kAnalysis, "Sum `total`{.value}.\n");
    const ChildResult slot = bench.dynlab({"check", "mine"});
    EXPECT_EQ(slot.exit_code, 1);
    EXPECT_THAT(slot.output, HasSubstr("total"));
    EXPECT_THAT(slot.output, HasSubstr("report.md:1"));
    make_folder(bench, "-- ---\n-- titel: A\n-- ---\n");
    EXPECT_THAT(bench.dynlab({"check", "mine"}).output, HasSubstr("did you mean"));
}

TEST(check_command, a_folder_that_takes_too_long_or_is_too_large_is_given_up) {
    const Workbench bench;
    make_folder(bench, "while true do end\n");
    FolderLimits limits;
    limits.time.processor = std::chrono::seconds(1);
    const CheckResult endless = check_folder(bench.path("mine"), DYNLAB_PROGRAM, {}, limits);
    ASSERT_EQ(endless.findings.size(), 1u);
    EXPECT_EQ(endless.findings[0].id, "analysis-fails");
    EXPECT_THAT(message_text(endless.findings[0].what), HasSubstr("used more than 1 s of processor time"));
    limits.folder_bytes = 10;
    EXPECT_EQ(check_folder(bench.path("mine"), DYNLAB_PROGRAM, {}, limits).findings.at(0).id, "folder-too-large");
    limits = {};
    limits.files = 2;
    EXPECT_EQ(check_folder(bench.path("mine"), DYNLAB_PROGRAM, {}, limits).findings.at(0).id, "folder-too-large");
}

TEST(check_command, a_program_that_is_missing_here_is_no_fault_of_the_folder) {
    Workbench bench;
    make_folder(bench);
    bench.hide_program("pandoc");
    const ChildResult result = bench.dynlab({"check", "mine"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(result.error_output, "dynlab: pandoc is not installed. Install it with: sudo apt install pandoc\n");
}

TEST(check_command, open_questions_and_missing_answers_are_found_by_line_and_name) {
    const Workbench bench;
    make_folder(bench, std::string("-- ---\n-- title: A\n-- answers:\n--   sum: number\n--   gain: number\n-- ---\n") +
                           kAnalysis + "answer('sum', 3)\n-- YOUR CODE HERE\n");
    const auto json = nlohmann::json::parse(bench.dynlab({"check", "mine", "--json"}).output);
    ASSERT_EQ(json.at("findings").size(), 2u) << json.dump(1);
    EXPECT_EQ(json.at("findings").at(0).at("id"), "answer-open");
    EXPECT_EQ(json.at("findings").at(0).at("place"), "analysis.lua:9");
    EXPECT_EQ(json.at("findings").at(1).at("id"), "answer-missing");
    EXPECT_THAT(json.at("findings").at(1).at("what").get<std::string>(), HasSubstr("\"gain\" (number)"));
    make_folder(bench, std::string(kAnalysis) + "-- VOTRE CODE ICI\n");
    const auto french = nlohmann::json::parse(bench.dynlab({"check", "mine", "--json"}).output);
    EXPECT_EQ(french.at("findings").at(0).at("id"), "answer-open") << french.dump(1);
}

// oracle: the questions as they are numbered here
TEST(check_command, a_question_with_several_blanks_is_one_finding) {
    const Workbench bench;
    make_folder(bench, std::string("-- %% [markdown]\n-- **Question 1.** How?\n\n-- %%\n") + kAnalysis +
                           "-- YOUR CODE HERE\n\n-- %% [markdown]\n-- *Your answer:*\n--\n-- **Question 2.** Why?\n--\n"
                           "-- *Your answer:*\n--\n-- # Learnt\n--\n-- *Your answer:*\n");
    const auto json = nlohmann::json::parse(bench.dynlab({"check", "mine", "--json"}).output);
    std::vector<std::string> reported;
    for (const auto& issue : json.at("findings"))
        if (issue.at("id") == "answer-open") reported.push_back(issue.at("what"));
    EXPECT_THAT(
        reported,
        ElementsAre(
            "Question 1 is unanswered: the lines \"YOUR CODE HERE\" and \"Your answer:\" are still in the text.",
            "Question 2 is unanswered: the line \"Your answer:\" is still in the text.",
            "The line \"Your answer:\" is still in the text."));
}

// oracle: the reference solution earns all points; percent instead of a ratio loses the points of that check
TEST(check_command, reports_what_the_checks_of_the_lesson_say) {
    const Workbench bench;
    ASSERT_EQ(bench.dynlab({"new", "01", "mine"}).exit_code, 0);
    bench.shell("cp " DYNLAB_SOURCE_DIR "/lessons/01_process_models/lesson.lua mine/analysis.lua");
    const ChildResult solved = bench.dynlab({"check", "mine"});
    EXPECT_EQ(solved.exit_code, 0) << solved.output;
    EXPECT_THAT(solved.output, HasSubstr("checks of lesson 01_process_models: 19 of 19 points"));
    bench.shell("sed -i 's/answer(\"overshoot\", /answer(\"overshoot\", 100*/' mine/analysis.lua");
    const ChildResult percent = bench.dynlab({"check", "mine"});
    EXPECT_EQ(percent.exit_code, 0) << percent.output;
    EXPECT_THAT(percent.output, HasSubstr("checks of lesson 01_process_models: 18 of 19 points"));
    EXPECT_THAT(percent.output, HasSubstr("check-failed"));
    EXPECT_THAT(percent.output, ContainsRegex("This is in percent; answer with a ratio[[:space:]]+below 1"));
}

TEST(check_command, reports_whether_the_pdf_in_the_folder_is_that_of_the_analysis) {
    const Workbench bench;
    make_folder(bench);
    ASSERT_EQ(bench.dynlab({"report", "mine", "-o", "mine/report.pdf"}).exit_code, 0);
    EXPECT_THAT(bench.dynlab({"check", "mine"}).output, HasSubstr("report.pdf is up to date"));
    bench.shell("touch -d 2020-01-01 mine/report.pdf");
    EXPECT_THAT(bench.dynlab({"check", "mine"}).output, HasSubstr("report.pdf is up to date"));
    bench.write("mine/values.csv", "y\n1\n5\n");
    const ChildResult old = bench.dynlab({"check", "mine"});
    EXPECT_EQ(old.exit_code, 0);
    EXPECT_THAT(old.output, HasSubstr("pdf-outdated\n    report.pdf: "));
    bench.shell("touch mine/report.pdf");
    EXPECT_THAT(bench.dynlab({"check", "mine"}).output, HasSubstr("pdf-differs"));
}

TEST(check_command, a_students_untouched_copy_gets_a_list_of_open_items) {
    const Workbench bench;
    ASSERT_EQ(bench.dynlab({"new", "02", "mine"}).exit_code, 0);
    const ChildResult result = bench.dynlab({"check", "mine"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.output, HasSubstr("answer-open"));
    EXPECT_THAT(result.output, Not(HasSubstr("analysis-fails")));
}

TEST(check_command, a_folder_without_analysis_breaks_a_rule) {
    const Workbench bench;
    bench.write("mine/notes.txt", "nothing");
    const ChildResult result = bench.dynlab({"check", "mine"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.output, HasSubstr("The folder has no file analysis.lua."));
    EXPECT_THAT(result.output, HasSubstr("report.md: "));
}

/// The language asks nothing of files that cannot be read.
TEST(check_command, french_work_without_a_readable_analysis_gets_a_message) {
    const Workbench bench;
    bench.write("mine/report.md", "---\ntitle: A\nlang: fr\n---\n\nLe gain.\n");
    const ChildResult missing = bench.dynlab({"check", "mine"});
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_THAT(missing.output, HasSubstr("analysis.lua"));
    EXPECT_THAT(missing.error_output, IsEmpty());
    bench.shell("mkfifo mine/analysis.lua");
    const ChildResult pipe = bench.shell("timeout 60 $DYNLAB check mine");
    EXPECT_EQ(pipe.exit_code, 1) << pipe.error_output;
    EXPECT_THAT(pipe.output, HasSubstr("analysis.lua"));
}

TEST(check_command, a_pdf_is_checked_by_itself_against_the_template_asked_for) {
    const Workbench bench;
    make_folder(bench);
    ASSERT_EQ(bench.dynlab({"report", "mine", "-o", "-odd; name.pdf"}).exit_code, 0);
    bench.write("lab.md", "---\nsections: |\n  Process | Procédé\n---\n");
    const ChildResult lab = bench.dynlab({"check", "--template", "lab.md", "--", "-odd; name.pdf"});
    EXPECT_EQ(lab.exit_code, 1);
    EXPECT_THAT(lab.output, HasSubstr("section-missing"));
    bench.write("own.md", "---\npages: 1\n---\n");
    const ChildResult own = bench.dynlab({"check", "--template", "own.md", "--", "-odd; name.pdf"});
    EXPECT_EQ(own.exit_code, 0) << own.output;
    EXPECT_THAT(own.output, HasSubstr("checked as own: 1 page (limit: 1)"));
}

TEST(check_command, misuse_ends_with_two) {
    const Workbench bench;
    const ChildResult none = bench.dynlab({"check", "nowhere"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.error_output, HasSubstr("file or folder not found: nowhere\n"));
    bench.write("a.pdf", "x");
    const ChildResult unknown = bench.dynlab({"check", "a.pdf", "--template", "novel"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.error_output, HasSubstr("the templates are class_summary, exercise_sheet"));
    EXPECT_EQ(bench.dynlab({"check", "a.pdf", "--pages", "0"}).exit_code, 2);
    EXPECT_EQ(bench.dynlab({"check"}).exit_code, 2);
    EXPECT_EQ(bench.dynlab({"check", "a.pdf"}).exit_code, 1);
}

}  // namespace test_check_command
}  // namespace dynlab::test
