#include <gmock/gmock.h>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_unfair_submissions {
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kAnswers = "--   x: number\n--   v: vector\n--   K: number\n";
constexpr const char* kSolution =
    "answer('x', 42)\nanswer('v', vector{1, 2, 3})\nlocal d = load('suspension')\nanswer('K', (max(d.y) - "
    "d.y[1])/max(d.u))\n"
    "report.value('x', 42)\n";
constexpr const char* kChecks =
    "check{id = 'x', points = 2, test = function(a) return near(a.x, 42, {rel = 0.05}) end}\n"
    "check{id = 'below', test = function(a) return not (a.x > 1000) end}\n"
    "check{id = 'v', test = function(a) return all_of(near(a.v, vector{1, 2, 3}), #a.v == 3) end}\n"
    "check{id = 'empty', test = function(a) return near(a.v - a.v, a.v - a.v, {abs = 1}) end}\n"
    "check{id = 'follows', rerun = 'suspension', test = function(a, b) return near(b.K, b.K > 0 and b.K < 1e5 and b.K, "
    "{rel = 0.1}) end}\n";

constexpr const char* kRight = "answer('x', 42)\nanswer('v', vector{1, 2, 3})\n";
constexpr const char* kWrong = "answer('x', 1)\n";

std::string zip_of(const std::string& script, const std::string& to) {
    return "rm -rf z; mkdir z; printf '%b' \"" + script +
           "\" > z/analysis.lua; (cd z && zip -q ../z.zip analysis.lua); mv z.zip '" + to + "'";
}

std::string row_of(GradingBench& bench, const std::string& id) {
    return bench.bench().shell("grep '^" + id + "' out/gradebook.csv").output;
}

// oracle: the platform's own part of a name, which comes first
TEST(unfair_submissions, no_student_submits_for_another_by_the_name_of_a_file) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    work.write("roster.csv", "id,name,canvas,moodle\n1002,Bob Victim,502,502\n1003,Eve Evil,503,503\n");
    const std::string bob = "answer('x', 42)\\n", eve = "answer('x', 1)\\n";
    work.shell(zip_of(bob, "in/victimbob_502_9002_work.zip"));
    work.shell(zip_of(eve, "in/evileve_503_9003_x_502_assignsubmission_file_.zip"));
    ASSERT_EQ(bench.grade({"--roster", "roster.csv"}).exit_code, 0);
    EXPECT_THAT(row_of(bench, "1002"), HasSubstr("victimbob_502_9002_work,graded,3"));
    EXPECT_THAT(row_of(bench, "1003"), HasSubstr("evileve_503"));

    work.shell("rm -r in out; mkdir in");
    work.shell(zip_of(bob, "in/Bob Victim_502_assignsubmission_file_work.zip"));
    work.shell(zip_of(eve, "in/Eve Evil_503_assignsubmission_file_q_502_assignsubmission_file_.zip"));
    ASSERT_EQ(bench.grade({"--roster", "roster.csv"}).exit_code, 0);
    EXPECT_THAT(row_of(bench, "1002"), HasSubstr("graded,3"));
    EXPECT_THAT(row_of(bench, "1003"), HasSubstr("Eve Evil_503"));
}

// oracle: the instructor's view; of two submissions the best submission counts, and that there are two is said
TEST(unfair_submissions, two_of_one_student_are_reported_and_typed_text_is_passed_over) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    work.write("roster.csv", "id,name,moodle\n1002,Bob Victim,502\n1003,Eve Evil,503\n");
    work.write("in/Bob Victim_502_assignsubmission_file/analysis.lua", "answer('x', 42)\n");
    work.write("in/Bob Victim_502_assignsubmission_onlinetext/onlinetext.html", "hello");
    work.write("in/Eve Evil_503_assignsubmission_file/analysis.lua", "answer('x', 42)\n");
    work.write("in/Eve Evil/analysis.lua", kWrong);
    work.write("in/notes.rar", "Rar!");
    const ChildResult graded = bench.grade({"--roster", "roster.csv"});
    EXPECT_EQ(graded.exit_code, 1);
    EXPECT_THAT(graded.output, HasSubstr("\"notes.rar\" cannot be read"));
    EXPECT_THAT(row_of(bench, "1002"), HasSubstr("graded,3"));
    EXPECT_THAT(row_of(bench, "1003"), HasSubstr("graded,3"));
    const std::string summary = work.read("out/summary.md");
    EXPECT_THAT(summary, HasSubstr("several submissions"));
    EXPECT_THAT(summary, HasSubstr("notes.rar"));
    EXPECT_THAT(work.read("out/gradebook.csv"), Not(HasSubstr("onlinetext")));
}

// oracle: the other answers, which are right
TEST(unfair_submissions, an_empty_vector_spoils_no_other_check) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", "answer('x', 42)\nanswer('v', zeros(0))\n");
    ASSERT_EQ(bench.grade().exit_code, 0);
    const auto tests = bench.result("a").at("tests");
    EXPECT_EQ(tests[0].value("score", -1.0), 2);
    EXPECT_EQ(tests[2].value("score", -1.0), 0);
    EXPECT_EQ(tests[3].value("score", -1.0), 1);
}

// oracle: a comparison with NaN is false, its contrary true
TEST(unfair_submissions, what_is_no_number_passes_no_comparison) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", "answer('x', 0/0)\nanswer('v', vector{1, 2, math.huge})\n");
    ASSERT_EQ(bench.grade().exit_code, 0);
    const auto tests = bench.result("a").at("tests");
    for (const auto& test : tests) EXPECT_EQ(test.value("score", -1.0), 0) << test;
    EXPECT_THAT(tests[1].at("output").get<std::string>(), HasSubstr("NaN"));
}

// oracle: the number that the first check wants; four vectors of 50,000 numbers of 17 digits have 3.8 MB
TEST(unfair_submissions, answers_that_are_too_large_together_cost_no_other) {
    GradingBench bench("--   a: number\n--   v1: vector\n--   v2: vector\n--   v3: vector\n--   v4: vector\n",
                       "check{id = 'a', test = function(a) return near(a.a, 1) end}\n"
                       "check{id = 'v4', test = function(a) return #a.v4 == 2 end}\n",
                       "answer('a', 1)\nfor i = 1, 4 do answer('v' .. i, vector{1, 2}) end\n");
    bench.submit_file("a", "answer('a', 1)\nfor i = 1, 4 do answer('v' .. i, rand(50000, 1)) end\n");
    const ChildResult graded = bench.grade();
    EXPECT_THAT(bench.result("a").dump(), HasSubstr("\\\"v3\\\" is too large")) << graded.output;
    EXPECT_EQ(bench.result("a").at("tests")[0].value("score", -1.0), 1);
}

// oracle: digits, of which a message that gives nothing away has none
TEST(unfair_submissions, feedback_reports_no_distance_on_records_that_no_one_has_seen) {
    GradingBench bench(
        kAnswers,
        "check{id = 'own', test = function(a) return near(a.K, 1) end}\n"
        "check{id = 'rerun', rerun = 'suspension', test = function(a, b) return near(b.K, truth(b).gain) end}\n"
        "check{id = 'hidden', test = function(a) return points_between(a.K/max(hidden('suspension').y), 1e8, "
        "1e9) end}\n",
        kSolution);
    bench.submit_file("a", "answer('K', 1e3)\n");
    ASSERT_EQ(bench.grade().exit_code, 1);
    const auto tests = bench.result("a").at("extra_data").at("dynlab").at("checks");
    EXPECT_THAT(tests[0].at("message").get<std::string>(), HasSubstr("The error is"));
    EXPECT_EQ(tests[0].at("stored_message").at("id"), "The error is {}; the largest allowed error is {}.");
    for (const int k : {1, 2}) {
        const std::string message = tests[k].at("message");
        EXPECT_FALSE(message.empty());
        EXPECT_EQ(message.find_first_of("0123456789"), std::string::npos) << message;
    }
}

// oracle: the lesson's template, whatever the student's own files say; what was not made keeps no rule
TEST(unfair_submissions, documents_are_held_against_the_lessons_rules) {
    GradingBench bench("--   x: number\n-- template: lab_report\n",
                       "check{id = 'document', document = true, test = function() return no_finding('section-missing', "
                       "'pages') end}\n",
                       "answer('x', 42)\n");
    bench.submit_file("own_template", "-- ---\n-- title: T\n-- template: lesson\n-- ---\nanswer('x', 42)\n");
    bench.bench().write("in/own_template/report.md", "---\ntitle: T\n---\n\nNothing.\n");
    bench.submit_file("no_report", "answer('x', 42)\n");
    std::string sections;
    for (const char* title : {"Process", "Experiment design", "Raw data", "Pre-processing",
                              "Choice of the model structure", "Parameter estimation", "Validation", "Conclusion"})
        sections += std::string("# ") + title + "\n\nWords.\n\n";
    const std::string whole = "---\ntitle: T\n---\n\n" + sections;
    bench.bench().write("home/lessons/99_small/report.en.md", whole);
    bench.submit_file("whole", "answer('x', 42)\n");
    bench.bench().write("in/whole/report.md", whole);
    const ChildResult graded = bench.grade();
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(GradingBench::score(bench.result("whole")), 1);
    EXPECT_EQ(GradingBench::score(bench.result("own_template")), 0);
    EXPECT_EQ(GradingBench::score(bench.result("no_report")), 0);
}

// oracle: the times that zip keeps
TEST(unfair_submissions, an_export_keeps_the_times_of_what_was_submitted) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    work.shell(zip_of("answer('x', 42)\\n", "in/early.zip"));
    work.shell(zip_of("answer('x', 42)\\n", "in/late: 2.zip"));
    work.shell(
        "touch -d '2026-03-01 17:00' in/early.zip; touch -d '2026-03-01 21:00' 'in/late: 2.zip'; cd in && zip -q "
        "../all.zip "
        "*.zip && rm *.zip && mv ../all.zip .");
    work.write("deadlines.csv", "submission,deadline\n*,2026-03-01 18:00\n");
    const ChildResult graded =
        bench.bench().dynlab({"grade", "in/all.zip", "--lesson", "99", "--out", "out", "--isolation",
                              GradingBench::level(), "--no-pdf", "--deadlines", "deadlines.csv"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    const auto late = [&](const char* name) {
        return bench.result(name).at("extra_data").at("dynlab").at("late_hours").get<double>();
    };
    EXPECT_EQ(late("early"), 0);
    EXPECT_NEAR(late("late: 2"), 3, 0.01);
}

// oracle: the others' marks, and a summary
TEST(unfair_submissions, names_that_are_no_text_and_endless_messages_stop_nothing) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("honest", kRight);
    bench.submit_file("talks", "error(string.rep('x ', 2000000))\n");
    work.shell("mkdir \"$(printf 'in/latin\\351')\" && cp in/honest/analysis.lua \"$(printf 'in/latin\\351')\"/");
    work.shell("mkdir in/loop && ln -s loop in/loop/loop && cp in/honest/analysis.lua in/loop/");
    work.shell("mkdir in/sparse && cp in/honest/analysis.lua in/sparse/ && truncate -s 50G in/sparse/big");
    work.write("deadlines.csv", "submission,deadline\n*,2096-03-01 18:00\n");
    const ChildResult graded = work.dynlab({"grade", "in", "--lesson", "99", "--out", "out", "--isolation",
                                            GradingBench::level(), "--deadlines", "deadlines.csv"});
    ASSERT_EQ(graded.exit_code, 1) << graded.error_output;
    EXPECT_EQ(GradingBench::score(bench.result("honest")), 5);
    EXPECT_EQ(GradingBench::score(bench.result("loop")), 5);
    EXPECT_EQ(GradingBench::score(bench.result("latiné")), 5);
    EXPECT_THAT(GradingBench::error_reason(bench.result("sparse")),
                HasSubstr("too large: dynlab examines at most 2000 files and 200 MB"));
    EXPECT_THAT(graded.output,
                AllOf(HasSubstr("need"), HasSubstr(" attention:\n"), HasSubstr("  \"sparse\" cannot be read")));
    EXPECT_LT(read_file(work.path("out/results/talks/results.json")).size(), 20000u);
    EXPECT_TRUE(std::filesystem::exists(work.path("out/summary.pdf")));
    EXPECT_EQ(work.shell("grep -c ',graded,' out/gradebook.csv").output, "4\n");
}

// oracle: files of the host
TEST(unfair_submissions, scripts_load_nothing_from_outside_their_folder_at_either_level) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.bench().write("secret.csv", "a\n42\n");
    bench.submit_file("absolute", "answer('x', load('" + bench.bench().path("secret.csv").string() + "').a[1])\n");
    bench.submit_file("up", "answer('x', load('../../secret.csv').a[1])\n");
    bench.submit_file("own", "answer('x', load('mine.csv').a[1])\n");
    bench.bench().write("in/own/mine.csv", "a\n42\n");
    const ChildResult graded =
        bench.bench().dynlab({"grade", "in", "--lesson", "99", "--out", "out", "--isolation", "process", "--no-pdf"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    for (const char* name : {"absolute", "up"}) {
        EXPECT_EQ(GradingBench::score(bench.result(name)), 0) << name;
        EXPECT_THAT(GradingBench::error_reason(bench.result(name)), HasSubstr("is outside the folder"));
    }
    EXPECT_EQ(GradingBench::score(bench.result("own")), 3);
}

// oracle: the messages for the instructor
TEST(unfair_submissions, the_instructor_gets_messages_about_slips_and_scripts_without_an_end) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    work.write("roster.csv", "id,name,group,moodle\n1,Student One,g1,111\n2,Student Two,g1,112\n");
    work.write("in/Student One_111_assignsubmission_file/analysis.lua", "answer('x', 42)\nwhile true do end\n");
    work.write("out/marks.csv",
               "who,check,points,reason\ng9,x,1,typo\n"
               "Student One_111_assignsubmission_file,nosuch,1,typo\n");
    work.write("deadlines.csv", "submission,deadline\n*,2001-01-01 12:00\ng8,2001-01-01 12:00\n");
    const ChildResult graded =
        bench.grade({"--roster", "roster.csv", "--deadlines", "deadlines.csv", "--timeout", "2", "--accept-late"});
    EXPECT_EQ(graded.exit_code, 1);
    for (const char* words : {"no submission, group or student is named \"g9\"", "unknown check \"nosuch\"",
                              "the row of \"g8\": the group \"g8\" does not exist"})
        EXPECT_THAT(graded.error_output, HasSubstr(words));
    const std::string summary = work.read("out/summary.md");
    EXPECT_THAT(summary, HasSubstr("stopped: "));
    EXPECT_THAT(summary, HasSubstr("was late; points deducted: 3 ("));
    EXPECT_THAT(row_of(bench, "1"), HasSubstr("graded"));
    EXPECT_THAT(row_of(bench, "2"), HasSubstr("graded"));  // the group's

    const ChildResult other = bench.bench().dynlab(
        {"grade", "in", "--lesson", "04", "--out", "out", "--isolation", GradingBench::level(), "--no-pdf"});
    EXPECT_NE(other.exit_code, 0);
}

}  // namespace test_unfair_submissions
}  // namespace dynlab::test
