// What groups handed in to a course, graded and taken back as scores.
#include <gmock/gmock.h>

#include "course/course_bench.h"
#include "course/store/graded_work.h"

namespace dynlab::test {
namespace test_graded_work {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class graded_work : public ::testing::Test {
  protected:
    graded_work() : bench_(4, 1) {
        CourseBench::expect_done(bench_.course({"assignment", "talk", "--kind", "talk", "--first", "2026-04-01 12:00",
                                                "--criteria", "clarity:5,script:10"}));
        const Workbench& work = bench_.bench();
        work.write("home/lessons/99_small/lesson.lua",
                   "-- ---\n-- title: Small\n-- lesson: 99_small\n-- answers:\n--   x: number\n--   y: number\n-- "
                   "---\nanswer('x', 42)\nanswer('y', 1)\n");
        work.write("home/lessons/99_small/checks.lua",
                   "check{id = 'x', points = 3, test = function(a) return a.x == 42 end}\n"
                   "check{id = 'y', points = 1, test = function(a) return a.y == 1 end}\n");
        work.shell("ln -s \"$DYNLAB_HOME/report_templates\" \"$DYNLAB_HOME/data\" home/");
    }
    void receive(const std::string& file, const std::string& content, const std::string& at) {
        CourseBench::expect_done(bench_.hand_in(file, content, at, {"--assignment", "talk"}));
    }
    CourseBench bench_;
};

// oracle: the newest script of each group by hand, and 10 points of the criterion for 4 of the checks
TEST_F(graded_work, of_a_talk_becomes_scores_of_a_criterion) {
    const Workbench& work = bench_.bench();
    receive("group-01.lua", "answer('x', 1)\n", "2026-03-30 10:00");
    receive("group-02.lua", "answer('x', 42)\n", "2026-03-30 10:00");
    receive("group-01.lua", "answer('x', 42)\nanswer('y', 1)\n", "2026-03-31 10:00");
    work.write("p/analysis.lua", "answer('y', 1)\n");
    work.shell("cd p && zip -q ../group-03.zip analysis.lua");
    CourseBench::expect_done(bench_.course({"submit", "group-03.zip", "--assignment", "talk", "--no-checks", "--at",
                                            "2026-03-31 11:00", "--isolation", CourseBench::level()}));
    const ChildResult laid_out = bench_.course({"work", "talk", "-o", "work"});
    EXPECT_EQ(laid_out.exit_code, 1);
    EXPECT_THAT(laid_out.error_output, HasSubstr("neither script nor pack of group-04"));
    EXPECT_EQ(work.read("work/group-01/analysis.lua"), "answer('x', 42)\nanswer('y', 1)\n");
    EXPECT_EQ(work.shell("date -u -r work/group-01/analysis.lua '+%F %R'; ls work").output,
              "2026-03-31 10:00\ngroup-01\ngroup-02\ngroup-03.zip\n");
    EXPECT_THAT(bench_.course({"work", "talk", "-o", "work"}).error_output, HasSubstr("exists already"));

    const ChildResult graded = work.shell(
        "DYNLAB_HOME=$PWD/home $DYNLAB grade work --lesson 99 --out marks --no-pdf "
        "--roster roster.csv --isolation " +
        CourseBench::level());
    ASSERT_TRUE(std::filesystem::exists(work.path("marks/gradebook.csv"))) << graded.error_output;
    const auto take = [&](const std::string& criterion) {
        return bench_.course(
            {"scores", "talk", "marks/gradebook.csv", "--graded", criterion, "--at", "2026-04-02 10:00"});
    };
    EXPECT_THAT(take("beauty").error_output, HasSubstr("talk has no criterion \"beauty\"; its criteria are clarity"));
    EXPECT_THAT(take("script").output, HasSubstr("talk: 3 new scores"));
    EXPECT_THAT(bench_.course({"export", "talk"}).output, AllOf(HasSubstr("group-01"), Not(HasSubstr("beauty"))));
    const std::string shown = bench_.course({"marks", "talk", "--at", "2026-04-02 11:00"}).output;
    EXPECT_THAT(shown, ::testing::ContainsRegex("group-01 +- +10 "));
    EXPECT_THAT(shown, ::testing::ContainsRegex("group-02 +- +7.5 "));
    EXPECT_THAT(shown, ::testing::ContainsRegex("group-03 +- +2.5 "));
    EXPECT_THAT(shown, ::testing::ContainsRegex("group-04 +- +- "));
    EXPECT_THAT(bench_.course({"scores", "talk", "roster.csv", "--graded", "script"}).error_output,
                HasSubstr("there is no column \"submission\""));
}

// oracle: the folder around it; what is killed in the middle is test_whole_folder's
TEST_F(graded_work, is_laid_out_whole_or_not_at_all) {
    receive("group-01.lua", "answer('x', 1)\n", "2026-03-30 10:00");
    receive("group-02.lua", "answer('x', 2)\n", "2026-03-30 10:00");
    Course course(bench_.bench().path("k"));
    const Assignment talk = assignment_named(course, "talk");
    Rows rows = course.database().query("SELECT hash FROM standing WHERE part = 'script' ORDER BY received_at DESC");
    ASSERT_TRUE(rows.next());
    const std::filesystem::path stored = course.file(rows.text(0)), around = bench_.bench().path("around");
    std::filesystem::rename(stored, bench_.bench().path("aside"));
    std::filesystem::create_directory(around);
    EXPECT_ANY_THROW(lay_out_work(course, talk, "first", around / "work"));
    EXPECT_TRUE(std::filesystem::is_empty(around));
    std::filesystem::rename(bench_.bench().path("aside"), stored);
    EXPECT_EQ(lay_out_work(course, talk, "first", around / "work").groups.size(), 2u);
}

}  // namespace test_graded_work
}  // namespace dynlab::test
