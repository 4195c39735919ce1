// The program's commands from outside. Oracles: the README's promises and exit codes, Lua's own arithmetic, equality of
// bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.h"

namespace dynlab::test {
namespace test_program {
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(program, runs_a_line_of_code) {
    const Workbench bench;
    const ChildResult result = bench.dynlab({"run", "-e", "print(1 + 1)"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.output, "2\n");
    EXPECT_THAT(result.error_output, IsEmpty());
    EXPECT_THAT(bench.files(), IsEmpty());
}

TEST(program, seed_option_repeats_a_run_and_replaces_the_scripts_seed) {
    const Workbench bench;
    bench.write("a.lua", "-- ---\n-- title: A\n-- seed: 5\n-- ---\n\nprint(string.format('%.17g', randn(1)[1]))\n");
    const std::string own = bench.dynlab({"run", "a.lua"}).output;
    EXPECT_EQ(own, bench.dynlab({"run", "a.lua", "--seed", "5"}).output);
    EXPECT_NE(own, bench.dynlab({"run", "a.lua", "--seed", "6"}).output);
    const ChildResult random = bench.dynlab({"run", "a.lua", "--seed", "random"});
    EXPECT_EQ(random.exit_code, 0);
    EXPECT_THAT(random.error_output, HasSubstr("--seed "));
}

// oracle: the numbers given
TEST(program, sliders_take_the_numbers_of_the_command_line) {
    const Workbench bench;
    bench.write("a.lua", "-- ---\n-- title: A\n-- ---\n-- %% id=a\nprint(\"k is \" .. slider(\"k\", 3, 1, 10))\n");
    EXPECT_THAT(bench.dynlab({"run", "a.lua"}).output, HasSubstr("k is 3"));
    EXPECT_THAT(bench.dynlab({"run", "a.lua", "--set", "k=5"}).output, HasSubstr("k is 5"));
    for (const char* command : {"weave", "report"}) {
        const ChildResult made = bench.dynlab({command, "a.lua", "-o", std::string(command) + ".md", "--set", "k=4"});
        EXPECT_EQ(made.exit_code, 0) << made.error_output;
        EXPECT_THAT(bench.read(std::string(command) + ".md"), HasSubstr("k is 4")) << command;
    }
    const ChildResult wrong = bench.dynlab({"run", "a.lua", "--set", "kk=5"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.error_output, HasSubstr("a.lua has no slider \"kk\"; the sliders are k\n"));
}

TEST(program, saves_dropped_figures_and_prints_their_paths) {
    const Workbench bench;
    bench.write("a.lua", "plot({1, 2, 3}, {1, 4, 9})\n");
    const ChildResult result = bench.dynlab({"run", "a.lua", "--out", "made"});
    EXPECT_EQ(result.exit_code, 0) << result.error_output;
    EXPECT_THAT(result.output, HasSubstr("made/"));
    EXPECT_TRUE(std::filesystem::exists(bench.path("made/record.json")));
    EXPECT_THAT(result.output, HasSubstr(".pdf"));
}

// oracle: the contents before
TEST(program, a_script_replaces_its_own_files_only) {
    const Workbench bench;
    bench.write("marks.csv", "somebody's");
    bench.write("b.lua",
                "save_csv('own.csv', {y = {1, 2}})\nsave(plot({1, 2}, {3, 4}), 'own.pdf')\n"
                "save_csv('marks.csv', {y = {1, 2}})\n");
    for (int again = 0; again < 2; ++again) {
        const ChildResult kept = bench.dynlab({"run", "b.lua"});
        EXPECT_EQ(kept.exit_code, 1);
        EXPECT_THAT(kept.error_output,
                    HasSubstr("b.lua:3: save_csv: 'marks.csv' already exists and was not written by dynlab. Save under "
                              "another name, move the file elsewhere, or replace the file (dynlab run --force)"));
    }
    EXPECT_EQ(bench.read("marks.csv"), "somebody's");
    EXPECT_EQ(bench.shell("echo \"save_csv('marks.csv', {y = {1, 2}})\" | $DYNLAB; head -1 marks.csv").output,
              "somebody's");
    EXPECT_EQ(bench.dynlab({"run", "b.lua", "--force"}).exit_code, 0);
    EXPECT_EQ(bench.dynlab({"run", "b.lua"}).exit_code, 0);
    EXPECT_THAT(bench.read("marks.csv"), HasSubstr("2"));
}

TEST(program, waits_for_files_the_script_saves_itself) {
    const Workbench bench;
    const ChildResult result = bench.dynlab({"run", "-e", "save(plot({1, 2}, {3, 4}), 'own.pdf')"});
    EXPECT_EQ(result.exit_code, 0) << result.error_output;
    EXPECT_THAT(bench.files(), ElementsAre("own.pdf"));
}

TEST(program, same_inputs_give_the_same_bytes_and_a_second_run_is_up_to_date) {
    const Workbench bench;
    const ChildResult made = bench.dynlab({"report", "01"});
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    EXPECT_EQ(made.output, bench.path("01_process_models.pdf").string() + "\n") << "nothing but the path in a pipe";
    EXPECT_THAT(made.error_output, IsEmpty());
    EXPECT_THAT(bench.files(), ElementsAre("01_process_models.pdf"));
    const std::string first = bench.read("01_process_models.pdf");
    EXPECT_THAT(bench.dynlab({"report", "01"}).output, HasSubstr("up to date"));
    const ChildResult elsewhere = bench.shell("mkdir other && cd other && DYNLAB_NO_CACHE=1 \"$DYNLAB\" report 01");
    ASSERT_EQ(elsewhere.exit_code, 0) << elsewhere.error_output;
    EXPECT_TRUE(first == bench.read("other/01_process_models.pdf"));
    for (const std::string& trace : {bench.path().string(), std::string("/tmp/"), std::string("root")}) {
        EXPECT_EQ(first.find(trace), std::string::npos) << trace;
    }
}

TEST(program, students_copy_has_no_solutions_and_its_report_works) {
    const Workbench bench;
    ASSERT_EQ(bench.dynlab({"new", "02", "mine"}).exit_code, 0);
    EXPECT_THAT(bench.read("mine/analysis.lua"), Not(HasSubstr("SOLUTION")));
    EXPECT_TRUE(std::filesystem::exists(bench.path("mine/data/winning_times/winning_times.csv")));
    const ChildResult run = bench.dynlab({"run", "mine/analysis.lua"});
    EXPECT_EQ(run.exit_code, 0) << run.error_output;
    const ChildResult report = bench.dynlab({"report", "mine"});
    ASSERT_EQ(report.exit_code, 0) << report.error_output;
    EXPECT_TRUE(std::filesystem::exists(bench.path("mine/report.pdf")));
    EXPECT_THAT(bench.files(), ElementsAre("mine"));
    const ChildResult again = bench.dynlab({"new", "02", "mine"});
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_THAT(again.error_output, HasSubstr("already exists"));
}

TEST(program, commands_without_an_argument_use_the_current_folder_if_it_contains_work) {
    const Workbench bench;
    bench.write("mine/analysis.lua", "print(1)\n");
    bench.write("mine/report.md", "---\ntitle: T\n---\n\nText\n");
    for (const std::string command : {"report", "check", "preview"}) {
        const ChildResult outside = bench.dynlab({command});
        EXPECT_EQ(outside.exit_code, 2) << command;
        EXPECT_THAT(
            outside.error_output,
            testing::StartsWith("dynlab: specify a folder or a script, for example: dynlab " + command + " mine\n"));
    }
    const ChildResult inside = bench.shell("cd mine && \"$DYNLAB\" report && \"$DYNLAB\" check");
    EXPECT_TRUE(std::filesystem::exists(bench.path("mine/report.pdf"))) << inside.error_output;
    EXPECT_THAT(inside.output, testing::HasSubstr("\nmine: "));
}

// oracle: the lesson's source
TEST(program, commands_that_it_shows_can_be_copied_whatever_the_folder_is_called) {
    const Workbench bench;
    const std::string folder = "Mein Ordner Übung é";
    const ChildResult made = bench.dynlab({"new", "02", folder});
    std::string::size_type before = 0;
    for (const std::string command : {"preview", "report", "check", "pack"}) {
        const std::string::size_type here = made.output.find("\n  dynlab " + command + " '" + folder + "'  ");
        EXPECT_NE(here, std::string::npos) << command << ":\n" << made.output;
        EXPECT_GT(here, before) << command;
        before = here;
    }
    const ChildResult plain = bench.dynlab({"new", "review", "my-review"});
    EXPECT_THAT(plain.output, testing::HasSubstr("dynlab report my-review "));
    EXPECT_THAT(bench.dynlab({"hint", folder}).output, testing::HasSubstr("dynlab hint '" + folder + "' "));
    EXPECT_THAT(bench.dynlab({"pack", folder}).error_output,
                testing::HasSubstr("dynlab report '" + folder + "', then"));
}

TEST(program, a_task_sheet_has_the_questions_and_no_solutions) {
    const Workbench bench;
    const ChildResult made = bench.dynlab({"sheet", "02"});
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    EXPECT_EQ(made.output, bench.path("02_least_squares_sheet.pdf").string() + "\n");
    const std::string text = bench.shell("pdftotext 02_least_squares_sheet.pdf -").output;
    for (int question = 1; question <= 8; ++question)
        EXPECT_THAT(text, HasSubstr("Question " + std::to_string(question))) << question;
    EXPECT_THAT(text, HasSubstr("Your answer"));
    for (const char* solution : {"The times decrease", "is far above all others", "SOLUTION", "STARTER"})
        EXPECT_THAT(text, Not(HasSubstr(solution)));
    ASSERT_EQ(bench.dynlab({"sheet", "04_estimators", "-o", "four.md"}).exit_code, 0);
    EXPECT_THAT(bench.read("four.md"), HasSubstr("**Question 4.**"));
}

// oracle: the run log that dynlab run writes
TEST(program, a_report_gives_the_record_of_its_run_whether_it_was_made_before_or_not) {
    const Workbench bench;
    bench.write("mine/analysis.lua",
                "-- ---\n-- answers:\n--   x: number\n-- ---\nanswer('x', randn())\nreport.value('sum', 3, '%d')\n"
                "plot(vector{1, 2})\n");
    bench.write("mine/report.md", "---\ntitle: A\n---\n\nSum `sum`{.value}.\n");
    ASSERT_EQ(bench.dynlab({"run", "mine/analysis.lua", "--out", "made"}).exit_code, 0);
    const auto run = nlohmann::json::parse(bench.read("made/record.json"));
    for (const char* file : {"first.json", "second.json"}) {
        const ChildResult made = bench.dynlab({"report", "mine", "--record", file});
        ASSERT_EQ(made.exit_code, 0) << made.error_output;
        const auto record = nlohmann::json::parse(bench.read(file));
        for (const char* part : {"answers", "values", "figures", "outputs", "seed"})
            EXPECT_EQ(record.at(part), run.at(part)) << part;
    }
}

TEST(program, code_of_a_pdf_can_be_copied) {  // oracle: the script's own signs
    const Workbench bench;
    bench.write("a.lua",
                "-- ---\n-- title: T\n-- ---\n-- %%\nx = 3^2\nprint('a ^ b, `\u00ea')\n-- %% [markdown]\n-- Now `s^2 "
                "\u00ea`.\n");
    ASSERT_EQ(bench.dynlab({"weave", "a.lua", "-o", "a.pdf"}).exit_code, 0);
    EXPECT_THAT(bench.shell("pdftotext -layout a.pdf -").output,
                AllOf(HasSubstr("x = 3^2"), HasSubstr("print('a ^ b, `\u00ea')"), HasSubstr(" a ^ b, `\u00ea\n"),
                      HasSubstr("Now s^2 \u00ea.")));
}

TEST(program, pictures_of_a_telephone_have_capital_letters) {
    const Workbench bench;
    bench.write("A/analysis.lua", "save(plot({1, 2}), 'small.png')\n");
    ASSERT_EQ(bench.dynlab({"run", "A"}).exit_code, 0);
    bench.shell("cp A/small.png 'A/IMG 001.PNG'");
    bench.write("A/report.md", "---\ntitle: A\n---\n\n![A rig.](IMG 001.PNG)\n");
    for (const char* output : {"a.pdf", "a.html"}) {
        const ChildResult made = bench.dynlab({"report", "A", "-o", output});
        EXPECT_EQ(made.exit_code, 0) << made.error_output;
    }
    EXPECT_THAT(bench.shell("pdfimages -list a.pdf").output, testing::ContainsRegex("1 +0 +image"));
    EXPECT_THAT(bench.read("a.html"), HasSubstr("data:image/png;base64,"));
}

TEST(program, weaves_to_html_and_markdown) {
    const Workbench bench;
    bench.write("a.lua", "-- ---\n-- title: Square\n-- ---\n\n-- %% [markdown]\n-- Some prose.\n\n-- %%\nprint(7*6)\n");
    ASSERT_EQ(bench.dynlab({"weave", "a.lua", "-o", "a.html"}).exit_code, 0);
    EXPECT_THAT(bench.read("a.html"), testing::AllOf(HasSubstr("Some prose."), HasSubstr("42"), HasSubstr("Square")));
    ASSERT_EQ(bench.dynlab({"weave", "a.lua", "-o", "a.md"}).exit_code, 0);
    EXPECT_THAT(bench.read("a.md"), testing::AllOf(HasSubstr("Some prose."), HasSubstr("42")));
}

TEST(program, has_help_and_doctor_is_content) {
    const Workbench bench;
    for (const char* command :
         {"run", "doctor"}) {  // of two programs; all others: tests/unit/cli/test_usage_message.cpp
        const ChildResult result = bench.dynlab({command, "--help"});
        EXPECT_EQ(result.exit_code, 0) << command;
        EXPECT_THAT(result.output, HasSubstr(command));
    }
    EXPECT_THAT(bench.dynlab({"--version"}).output, testing::MatchesRegex("dynlab [0-9]+\\.[0-9]+\\.[0-9]+\n"));
    EXPECT_EQ(bench.dynlab({"doctor"}).exit_code, 0);
    EXPECT_THAT(bench.dynlab({"lessons"}).output, HasSubstr("02_least_squares"));
    EXPECT_THAT(bench.dynlab({"help", "lsim"}).output, HasSubstr("lsim("));
    EXPECT_EQ(bench.dynlab({"help", "no_such_thing"}).exit_code, 1);
}

}  // namespace test_program
}  // namespace dynlab::test
