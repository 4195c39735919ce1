// Lessons by an instructor. Oracles: a lesson with one manual change, so that the error and its place are known; the
// installed course, which must not change; the data of the skeleton, a spring of 2.5 N/mm.
#include <gmock/gmock.h>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_own_course {
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kLesson = "my-course/lessons/08_springs";

/// The first commands of the guide.
std::string commands_of_guide() {
    const std::string guide = read_file(DYNLAB_SOURCE_DIR "/engine/scripting/reference/guides/guide-own-course.md");
    const std::size_t begin = guide.find("```sh\n") + 6;
    return guide.substr(begin, guide.find("```", begin) - begin);
}

/// The skeleton, made once, in the folder of a course, by the guide's commands.
class own_course : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        bench_ = new Workbench;
        made_ = new ChildResult(bench_->shell("set -e; dynlab() { \"$DYNLAB\" \"$@\"; }\n" + commands_of_guide()));
    }
    static void TearDownTestSuite() {
        delete made_;
        delete bench_;
    }
    static Workbench& bench() { return *bench_; }
    static ChildResult in_course(const std::string& words) {
        return bench().shell("$DYNLAB --course my-course " + words);
    }

    static Workbench* bench_;
    static ChildResult* made_;
};
Workbench* own_course::bench_ = nullptr;
ChildResult* own_course::made_ = nullptr;

TEST_F(own_course, skeleton_is_tested_reported_copied_checked_and_graded) {
    ASSERT_EQ(made_->exit_code, 0) << made_->error_output;
    EXPECT_EQ(
        bench().dynlab({"lint", std::string(kLesson) + "/lesson.lua", std::string(kLesson) + "/checks.lua"}).output,
        "");
    EXPECT_THAT(made_->output, HasSubstr("\ntexts: no errors\nchecks: no errors\ndocuments: no errors\n"));

    EXPECT_THAT(in_course("lessons").output, HasSubstr("08_springs             A spring and its stiffness\n"));
    EXPECT_THAT(bench().dynlab({"lessons"}).output, Not(HasSubstr("08_springs")));
    EXPECT_THAT(bench().shell("pdftotext 08_springs.pdf -").output,
                testing::ContainsRegex("The stiffness is 2[.][45]"));
    ASSERT_EQ(in_course("new 08 travail --lang fr").exit_code, 0);
    EXPECT_THAT(bench().read("travail/analysis.lua"), HasSubstr("Quelle est la raideur du ressort"));
    EXPECT_THAT(bench().read("travail/analysis.lua"), Not(HasSubstr("compliance = dot")));
    EXPECT_THAT(in_course("check travail").output, HasSubstr("0 sur 5\n"));
    bench().shell("mkdir -p in/right && cp " + std::string(kLesson) +
                  "/right_other_methods.lua in/right/analysis.lua && "
                  "mkdir in/wrong && cp " +
                  std::string(kLesson) + "/wrong_compliance.lua in/wrong/analysis.lua");
    const ChildResult graded =
        in_course("grade in --lesson 08 --out out --no-pdf --isolation " + GradingBench::level());
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    const auto score = [](const std::string& name) {
        return nlohmann::json::parse(bench().read("out/results/" + name + "/results.json")).at("score");
    };
    EXPECT_EQ(score("right"), 5);
    EXPECT_EQ(score("wrong"), 2);
    EXPECT_EQ(bench().dynlab({"new", "lesson", kLesson}).exit_code, 1) << "it exists already";
    EXPECT_THAT(bench().dynlab({"new", "lesson", "a lesson"}).error_output, HasSubstr("is not a valid lesson"));
}

TEST_F(own_course, brings_data_and_templates_that_come_before_the_installed_ones) {
    bench().write("my-course/data/own_record/SOURCE.md", "Weighed at home.\n");
    bench().write("my-course/data/own_record/own_record.csv", "t,y\n0,1\n1,2\n");
    bench().write("my-course/data/suspension/SOURCE.md", "Another one.\n");
    bench().write("my-course/data/suspension/suspension.csv", "t,y\n0,5\n1,6\n");
    bench().write("my-course/report_templates/memo.md",
                  "---\ntitle: A memo\nlang: en\n---\n\nThe sum is `sum`{.value}.\n\n::: {.cells}\n:::\n");
    bench().write(
        "a.lua",
        "-- ---\n-- title: A\n-- template: memo\n-- ---\n-- %%\nreport.value('sum', load('own_record').y[2] + "
        "load('suspension').y[1] + #load('crane').free_swing.t)\n");
    const ChildResult made = in_course("weave a.lua -o a.md");
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    EXPECT_THAT(bench().read("a.md"), testing::ContainsRegex("The sum is [0-9]+\\."));
    const ChildResult without = bench().dynlab({"run", "a.lua"});
    EXPECT_EQ(without.exit_code, 1);
    EXPECT_THAT(without.error_output, HasSubstr("unknown data set \"own_record\""));
    bench().write("my-course/data/own_record/own_record.csv", "t,y\n0,1\n1,1002\n");
    EXPECT_THAT(in_course("run -e \"print(load('own_record').y[2])\"").output, StartsWith("1002"));
    for (const auto& [folder, words] :
         {std::pair("nowhere", "folder not found:"), std::pair("in", "contains none of the folders lessons")}) {
        const ChildResult refused =
            bench().shell(std::string("mkdir -p in; DYNLAB_COURSE=") + folder + " $DYNLAB lessons");
        EXPECT_EQ(refused.exit_code, 1);
        EXPECT_THAT(refused.error_output, HasSubstr(words));
    }
}

/// One change to a file of the skeleton, and the expected message.
struct Planted {
    const char *file, *from, *to, *reported;
};

std::string replaced_once(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expect_reported(const Workbench& bench, const std::string& part, const Planted& planted) {
    bench.shell(std::string("rm -rf faulty && mkdir faulty && cp -r ") + kLesson + " faulty/08_springs");
    const std::string file = std::string("faulty/08_springs/") + planted.file;
    bench.write(file, replaced_once(bench.read(file), planted.from, planted.to));
    const ChildResult tested = bench.dynlab({"test-lesson", "faulty/08_springs", "--part", part});
    EXPECT_EQ(tested.exit_code, 1) << planted.reported;
    EXPECT_THAT(tested.output, HasSubstr(std::string("/faulty/08_springs/") + planted.reported)) << tested.error_output;
}

TEST_F(own_course, texts_with_faults_are_named_with_file_and_line) {
    for (const Planted& planted : {
             Planted{"lesson.lua", "-- lesson: 08_springs", "-- lesson: 09_springs",
                     "lesson.lua: the header names the lesson"},
             {"lesson.lua", "-- seed: 1", "-- sede: 1", "lesson.lua:6: "},
             {"lesson.lua", "local stiffness = 1/compliance", "local stiffness = 1/complaince",
              "lesson.lua:32: unknown function or variable 'complaince'; did you mean 'compliance'?"},
             {"lesson.lua", "-- BEGIN SOLUTION", "-- BEGIN SOLUTIONS", "lesson.lua:30: "},
             {"lesson.lua", "answer(\"noise\", ", "print(",
              "lesson.lua:9: the script never submits the answer \"noise\""},
             {"checks.lua", "points = 3,", "points = 3", "checks.lua:5: "},
             {"checks.lua", "near(a.stiffness, 1", "naer(a.stiffness, 1",
              "checks.lua:6: unknown function or variable 'naer'"},
             {"wrong_compliance.lua", "load(\"record\")", "load(\"record\"", "wrong_compliance.lua:4: "},
             {"hints.md", "2. With", "3. With", "hints.md:4: expected hint 2, starting"},
             {"checks.fr.po", "msgid \"The measurement errors\"", "msgid The measurement errors",
              "checks.fr.po: line 19: expected text in quotation marks"},
             {"tasks.fr.lua", "-- %% [markdown]\n-- # Ce qu'on a appris", "-- # Ce qu'on a appris", "tasks.fr.lua: "},
         })
        expect_reported(bench(), "texts", planted);
    const ChildResult whole = bench().dynlab({"test-lesson", "faulty/08_springs"});
    EXPECT_THAT(whole.error_output, HasSubstr("1 error in 08_springs; nothing was run"));
    EXPECT_EQ(bench().dynlab({"test-lesson", "faulty/08_springs", "--part", "prose"}).exit_code, 2);
    EXPECT_EQ(bench().dynlab({"test-lesson", "nowhere"}).exit_code, 1);
}

TEST_F(own_course, checks_that_do_not_do_what_they_are_for_are_reported) {
    for (const Planted& planted : {
             Planted{"wrong_compliance.lua", "-- expects: stiffness: This is the compliance", "-- expects: noise: off",
                     "wrong_compliance.lua:1: the script passes the check \"noise\", which it must fail"},
             {"wrong_compliance.lua", "This is the compliance", "Upside down",
              "wrong_compliance.lua:1: the check \"stiffness\" gives the message \"This is the compliance in mm/N"},
             {"right_other_methods.lua", "1/fit.theta[1])", "fit.theta[1])",
              "right_other_methods.lua: the script fails the check \"stiffness\""},
             {"lesson.lua", "answer(\"stiffness\", stiffness)", "answer(\"stiffness\", 2*stiffness)",
              "lesson.lua: the reference solution does not pass the check \"stiffness\""},
             {"lesson.lua",
              "-- BEGIN SOLUTION\nanswer(\"noise\", std(record.y - compliance*record.u))\n-- END SOLUTION",
              "answer(\"noise\", std(record.y - 0.4*record.u))\n",
              "lesson.lua: the unchanged starter script gets points for the check \"noise\""},
             {"checks.lua", "return near(a.noise,", "return near(nil,",
              "lesson.lua: the reference solution does not pass the check \"noise\""},
         })
        expect_reported(bench(), "checks", planted);
}

TEST_F(own_course, documents_with_gaps_and_copies_with_results_are_reported) {
    expect_reported(bench(), "documents",
                    {"lesson.lua", "(@fig:record), in N/mm", "(@fig:recrod), in N/mm", "lesson.lua: "});
    expect_reported(bench(), "documents",
                    {"lesson.lua", "-- BEGIN SOLUTION\nlocal compliance",
                     "report.value(\"given\", 2.5)\n-- BEGIN SOLUTION\nlocal compliance",
                     "lesson.lua: the student's copy (en) contains values of the solution: given"});
}

TEST_F(own_course, a_report_of_more_pages_than_its_header_allows_is_reported) {
    bench().shell(std::string("rm -rf long && mkdir long && cp -r ") + kLesson + " long/08_springs");
    std::string report = "---\ntitle: A report\nlang: en\npages: 1\n---\n\n# Springs\n\n";
    for (int i = 0; i < 60; ++i) report += "The spring was loaded, and its elongation read off the scale by eye.\n\n";
    bench().write("long/08_springs/report.en.md", report);
    const ChildResult tested = bench().dynlab({"test-lesson", "long/08_springs", "--part", "documents"});
    EXPECT_EQ(tested.exit_code, 1);
    EXPECT_THAT(tested.output, testing::ContainsRegex("long/08_springs/report.en.md: the report, page [0-9]+: .*page"));
}

}  // namespace test_own_course
}  // namespace dynlab::test
