#include <gmock/gmock.h>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_grade_export {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kAnswers = "--   x: number\n";
constexpr const char* kSolution = "answer('x', 42)\n";
constexpr const char* kChecks =
    "check{id = 'x', points = 2, about = 'The number', hint = 'Six times seven.',\n"
    "  test = function(a) return near(a.x, 42) end}\n";

// oracle: the columns and names that Moodle's importers ask for (mod/assign/feedback/offline and /file), and Canvas's
// import of gradebooks
TEST(grade_export, gives_platforms_what_they_import) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    Workbench& work = bench.bench();
    bench.submit_file("Anna Lovelace_900001_assignsubmission_file_", kSolution);
    bench.submit_file("Zoë_K_900002_assignsubmission_file_", "answer('x', 1)\n");
    bench.submit_file("kalmanrudolf_LATE_31_77_work", kSolution);
    work.write("roster.csv",
               "id,name,email,moodle,canvas\n1,Anna Lovelace,anna@u.example,,\n2,Zoë K,,900002,\n"
               "3,Rudolf Kalman,rk@u.example,,31\n4,Nobody Here,,,\n");
    bench.grade({"--roster", "roster.csv"});
    const auto summary = nlohmann::json::parse(work.read("out/summary.json"));
    EXPECT_EQ(summary.at("works"), 3);
    EXPECT_EQ(summary.at("checks").at(0).at("passed"), 2);
    EXPECT_EQ(summary.at("checks").at(0).at("mistakes").at(0).at("count"), 1);
    EXPECT_THAT(work.read("out/summary.md"), HasSubstr("No identical submissions."));
    EXPECT_THAT(work.read("out/summary.md"), AllOf(ContainsRegex("Anna Lovelace +[^\n]*graded[^\n]* 2 "),
                                                   ContainsRegex("Nobody Here +[^\n]*nothing submitted")));
    const ChildResult back =
        work.dynlab({"export-grades", "out", "--roster", "roster.csv", "--assignment", "Lab 4 (1234)"});
    EXPECT_EQ(back.output,
              "out/handed_back/moodle-grades.csv\nout/handed_back/moodle-feedback.zip\n"
              "out/handed_back/canvas-grades.csv\nout/handed_back/mail.csv\n");
    EXPECT_EQ(back.exit_code, 1);
    EXPECT_THAT(back.error_output, HasSubstr("Rudolf Kalman is missing from moodle-grades.csv"));
    EXPECT_THAT(back.error_output, Not(HasSubstr("Nobody")));
    const std::string moodle = work.read("out/handed_back/moodle-grades.csv");
    EXPECT_THAT(moodle,
                HasSubstr("Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Feedback comments\r\n"));
    EXPECT_THAT(moodle, HasSubstr("Participant 900001,Anna Lovelace,2,2,,2 of 2 points.\r\n"));
    EXPECT_THAT(moodle, HasSubstr("Participant 900002,Zoë K,0,2,,\"0 of 2 points.\nThe number: 0 of 2."));
    EXPECT_EQ(work.shell("python3 -c \"import zipfile; print('\\n'.join(zipfile.ZipFile("
                         "'out/handed_back/moodle-feedback.zip').namelist()))\"")
                  .output,
              "Anna Lovelace_900001_assignfeedback_file_/feedback.md\nZoë K_900002_assignfeedback_file_/feedback.md\n");
    EXPECT_EQ(work.read("out/handed_back/canvas-grades.csv"),
              "Student,ID,SIS User ID,SIS Login ID,Section,Lab 4 (1234)\r\n    Points Possible,,,,,2\r\n"
              "Rudolf Kalman,31,3,rk@u.example,,2\r\n");
    const std::string mail = work.read("out/handed_back/mail.csv");
    EXPECT_THAT(mail, HasSubstr("1,Anna Lovelace,,anna@u.example,results/Anna Lovelace_900001_assignsubmission_file_/"
                                "feedback.md,yes,2,2,"));
    // Once it was delivered only what changed is new.
    EXPECT_EQ(work.dynlab({"export-grades", "out", "--delivered"}).output, "3 files are recorded as delivered\n");
    work.write("out/marks.csv", "who,check,points,reason\nZoë_K_900002_assignsubmission_file_,x,1,half\n");
    bench.grade({"--roster", "roster.csv"});
    work.dynlab({"export-grades", "out", "--roster", "roster.csv"});
    const std::string again = work.read("out/handed_back/mail.csv");
    EXPECT_THAT(again, HasSubstr("file_/feedback.md,no,"));
    EXPECT_THAT(again, HasSubstr("results/Zoë_K_900002_assignsubmission_file_/feedback.md,yes,1,2,"));
    EXPECT_EQ(work.dynlab({"export-grades", "in"}).exit_code, 1);
}

// oracle: the help of the command, which says what 1 means
TEST(grade_export, platforms_without_known_students_are_reported) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    Workbench& work = bench.bench();
    bench.submit_file("1", kSolution);
    const auto back_with = [&](const std::string& columns, const std::string& numbers) {
        work.write("roster.csv", "id,name" + columns + "\n1,Anna Lovelace" + numbers + "\n");
        return work.dynlab({"export-grades", "out", "--roster", "roster.csv"});
    };
    work.write("roster.csv", "id,name\n1,Anna Lovelace\n");
    bench.grade({"--roster", "roster.csv"});
    const ChildResult none = back_with("", "");
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_EQ(none.output, "out/handed_back/mail.csv\n");
    EXPECT_THAT(none.error_output,
                AllOf(HasSubstr("moodle-grades.csv and moodle-feedback.zip were not written"),
                      HasSubstr("canvas-grades.csv was not written"), HasSubstr("no marks could be entered")));
    const ChildResult one = back_with(",canvas", ",31");
    EXPECT_EQ(one.exit_code, 0);
    EXPECT_THAT(one.error_output, AllOf(HasSubstr("moodle-grades.csv and moodle-feedback.zip were not written"),
                                        Not(HasSubstr("canvas-grades.csv was not written"))));
}

// oracle: the roster, which dynlab grade stores
TEST(grade_export, uses_the_roster_of_the_results_unless_another_is_given) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    Workbench& work = bench.bench();
    bench.submit_file("g1", kSolution);
    bench.submit_file("Anna Lovelace", kSolution);
    work.write("roster.csv",
               "id,name,group,email,canvas\n1001,Student One,g1,one@u.example,31\n"
               "1002,Anna Lovelace,,anna@u.example,\n");
    bench.grade({"--roster", "roster.csv"});
    work.dynlab({"export-grades", "out"});
    EXPECT_THAT(work.read("out/handed_back/mail.csv"),
                AllOf(HasSubstr("1001,Student One,g1,one@u.example,results/g1/feedback.md,yes,"),
                      HasSubstr("1002,Anna Lovelace,,anna@u.example,results/")));
    EXPECT_THAT(work.read("out/handed_back/canvas-grades.csv"), HasSubstr("Student One,31,1001,one@u.example,,2"));
    work.write("other.csv", "id,name,group,email\n1001,Student One,g1,uno@u.example\n");
    work.dynlab({"export-grades", "out", "--roster", "other.csv"});
    EXPECT_THAT(work.read("out/handed_back/mail.csv"), HasSubstr("1001,Student One,g1,uno@u.example,"));
}

// oracle: the French of the program, that of the lesson, and the decimal comma
TEST(grade_export, comments_are_in_the_language_of_the_feedback) {
    GradingBench bench(kAnswers,
                       "check{id = 'x', points = 2.5, about = 'The number', hint = 'Six times seven.',\n"
                       "  test = function(a) return near(a.x, 42) end}\n",
                       kSolution);
    Workbench& work = bench.bench();
    work.write("home/lessons/99_small/checks.fr.po",
               "msgid \"The number\"\nmsgstr \"Le nombre\"\n\nmsgid \"Six times seven.\"\nmsgstr \"Six fois sept.\"\n");
    bench.submit_file("Zoé_K_900002_assignsubmission_file_", "answer('x', 41)\n");
    bench.submit_file("Anna_L_900003_assignsubmission_file_", "answer('x', 1)\n");
    work.write("roster.csv", "id,name,moodle,language\n2,Zoé K,900002,fr\n3,Anna L,900003,en\n");
    bench.grade({"--roster", "roster.csv"});
    work.write("out/marks.csv", "who,check,points,reason\nZoé_K_900002_assignsubmission_file_,x,1.5,\n");
    bench.grade({"--roster", "roster.csv"});
    work.dynlab({"export-grades", "out", "--roster", "roster.csv"});
    const std::string moodle = work.read("out/handed_back/moodle-grades.csv");
    EXPECT_THAT(moodle, HasSubstr("\"Points\u202F: 1,5 sur 2,5.\nLe nombre\u202F: 1,5 sur 2,5. Noté par "
                                  "l'enseignant.\nSix fois sept."));
    EXPECT_THAT(moodle, HasSubstr("0 of 2.5 points.\nThe number: 0 of 2.5. The error is 97.6 %; the largest allowed "
                                  "error is 5 %.\nSix times seven."));
}

// oracle: the text of the reference solution
TEST(grade_export, model_answers_go_to_everybody_where_the_instructor_wants_it) {
    const std::string worked = std::string(kSolution) +
                               "-- %% [markdown]\n-- **Question 1.** How much?\n--\n-- BEGIN SOLUTION\n"
                               "-- Six times seven is forty-two.\n-- END SOLUTION\n";
    GradingBench bench(kAnswers, kChecks, worked);
    Workbench& work = bench.bench();
    bench.submit_file("Anna Lovelace_900001_assignsubmission_file_", kSolution);
    bench.grade();
    work.dynlab({"export-grades", "out"});
    EXPECT_THAT(work.read("out/handed_back/mail.csv"), Not(HasSubstr("model_answers")));
    bench.grade({"--answers"});
    const std::string answers = work.read("out/model_answers.md");
    EXPECT_THAT(answers, AllOf(HasSubstr("How much?"), HasSubstr("Six times seven is forty-two.")));
    EXPECT_THAT(answers, AllOf(Not(HasSubstr("answer('x'")), Not(HasSubstr("SOLUTION"))));
    work.dynlab({"export-grades", "out"});
    EXPECT_THAT(work.read("out/handed_back/mail.csv"),
                HasSubstr("results/Anna Lovelace_900001_assignsubmission_file_/feedback.md; model_answers.md\",yes,"));
    EXPECT_THAT(work.shell("unzip -l out/handed_back/moodle-feedback.zip").output,
                HasSubstr("Anna Lovelace_900001_assignfeedback_file_/model_answers.md"));
}

// oracle: the results of dynlab grade; Gradescope's form of results.json
TEST(grade_export, an_autograder_for_gradescope_grades_alone) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    Workbench& work = bench.bench();
    work.write("secret", "chosen by a test");
    work.write("own/more.lua",
               "check{id = 'hidden', points = 3, hint = 'Think again.', test = function(a)\n"
               "  return a.x > 41, 'the word that must not be seen' end}\n");
    ASSERT_EQ(work.dynlab({"gradescope", "99", "--secret", "secret", "--checks", "own", "-o", "a.zip"}).exit_code, 0);
    ASSERT_EQ(work.shell("mkdir -p g/source g/submission && cd g/source && unzip -q ../../a.zip").exit_code, 0);
    const std::string environment = "unset DYNLAB_HOME; export PREFIX=$PWD/prefix AUTOGRADER=$PWD/g; ";
    const ChildResult setup = work.shell(environment + "bash g/source/setup.sh");
    ASSERT_EQ(setup.exit_code, 0) << setup.error_output;
    EXPECT_THAT(work.shell("ls prefix/bin").output, AllOf(HasSubstr("dynlab\n"), HasSubstr("dynlab-boxed\n")));
    work.write("g/submission/analysis.lua", GradingBench::header(kAnswers) + "answer('x', 1)\n");
    const ChildResult run = work.shell(environment + "bash g/source/run_autograder");
    EXPECT_EQ(run.exit_code, 0) << run.error_output;
    const std::string text = work.read("g/results/results.json");
    const auto result = nlohmann::json::parse(text);
    EXPECT_EQ(result.at("score"), 0);
    EXPECT_EQ(result.at("tests").at(0).at("status"), "failed");
    EXPECT_EQ(result.at("tests").at(1).at("output"), "Think again.");
    EXPECT_THAT(text, Not(HasSubstr("must not be seen")));
    work.write("g/submission/analysis.lua", GradingBench::header(kAnswers) + kSolution);
    work.shell(environment + "bash g/source/run_autograder");
    EXPECT_EQ(nlohmann::json::parse(work.read("g/results/results.json")).at("score"), 5);
}

}  // namespace test_grade_export
}  // namespace dynlab::test
