#include <fmt/format.h>
#include <gmock/gmock.h>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_lessons_anywhere {
using ::testing::HasSubstr;
using ::testing::Not;

/// A user-written lesson with its data set, in the folder `mine/08_rc`.
class lessons_anywhere : public ::testing::Test {
  protected:
    lessons_anywhere() {
        bench_.write("mine/08_rc/lesson.lua", kHeader + kStart + "-- BEGIN SOLUTION\n" + kGain + "-- END SOLUTION\n");
        bench_.write("mine/08_rc/rc.csv", "t,u,y\n0,1,2\n0.1,2,4\n0.2,3,6\n");
        bench_.write("mine/08_rc/data/further/SOURCE.md", "Another one.\n");
        bench_.write("mine/08_rc/data/further/further.csv", "t,u,y\n0,1,2\n0.1,2,4\n");
        bench_.write("mine/08_rc/checks.lua",
                     "local d = load('rc')\ncheck{id = 'K', points = 4, test = function(a) return near(a.K, "
                     "mean(d.y)/mean(d.u)) end}\n"
                     "check{id = 'further', test = function(a) return load('further').y[2] == 4 end}\n");
    }

    static std::string level() { return GradingBench::level(); }

    const std::string kHeader = "-- ---\n-- title: RC circuit\n-- lesson: 08_rc\n-- answers:\n--   K: number\n-- ---\n";
    const std::string kStart = "-- %%\nlocal d, f = load('rc'), load('further')\n";
    const std::string kGain = "answer('K', mean(d.y)/mean(d.u))\n";
    Workbench bench_;
};

// oracle: the data set beside the lesson
TEST_F(lessons_anywhere, are_used_by_the_path_of_their_folder) {
    const std::string lesson = "mine/08_rc";
    EXPECT_EQ(bench_.dynlab({"report", lesson, "-o", "lesson.md"}).exit_code, 0);
    ASSERT_EQ(bench_.dynlab({"new", lesson, "work"}).exit_code, 0);
    EXPECT_EQ(bench_.read("work/data/rc/rc.csv"), bench_.read("mine/08_rc/rc.csv"));
    EXPECT_THAT(bench_.read("work/analysis.lua"), Not(HasSubstr("mean(d.y)")));
    bench_.write("work/analysis.lua", kHeader + kStart + kGain);
    EXPECT_EQ(bench_.dynlab({"run", "work/analysis.lua"}).exit_code, 0);

    // What a student changes in the data does not count.
    bench_.write("in/right/analysis.lua", kHeader + kStart + kGain);
    bench_.write("in/typed/analysis.lua", kHeader + "answer('K', 3)\n");
    bench_.write("in/typed/data/rc/rc.csv", "t,u,y\n0,1,3\n0.1,2,6\n");
    const ChildResult graded =
        bench_.dynlab({"grade", "in", "--lesson", lesson, "--out", "out", "--isolation", level(), "--no-pdf"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    const auto score = [&](const std::string& name) {
        return nlohmann::json::parse(bench_.read("out/results/" + name + "/results.json")).at("score");
    };
    EXPECT_EQ(score("right"), 5);
    EXPECT_EQ(score("typed"), 1);
    bench_.write("mine/08_rc/rc.csv", "t,u,y\n0,1,3\n0.1,2,6\n");
    bench_.dynlab({"grade", "in", "--lesson", lesson, "--out", "out", "--isolation", level(), "--no-pdf"});
    EXPECT_EQ(score("typed"), 5);
}

// oracle: the path as it was given, seen from another folder
TEST_F(lessons_anywhere, of_an_assignment_are_found_from_every_folder) {
    bench_.write("r.csv", "id,name,group\n1,Ada Byron,g1\n");
    bench_.write("in/g1/analysis.lua", kHeader + kStart + kGain);
    const ChildResult graded = bench_.shell(
        "set -e; $DYNLAB course init k; $DYNLAB course --course k import r.csv; $DYNLAB course --course k assignment "
        "lab "
        "--kind lab --lesson mine/08_rc --first '2026-03-01 12:00'; $DYNLAB course --course k submit in --at "
        "'2026-03-01 10:00' --isolation " +
        level() + "; cd k; $DYNLAB course grade lab --no-pdf --isolation " + level());
    EXPECT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_THAT(graded.output, HasSubstr("1 graded now"));
}

TEST_F(lessons_anywhere, are_listed_in_folders_that_a_variable_names) {
    bench_.write("others/08_rc/lesson.lua", "-- ---\n-- title: In the second folder\n-- ---\n");
    bench_.write("others/09_more/lesson.lua", "-- ---\n-- title: More\n-- ---\n");
    const std::string own = "export DYNLAB_LESSONS=mine:others; ";
    const std::string list = bench_.shell(own + "$DYNLAB lessons").output;
    EXPECT_THAT(list, HasSubstr("08_rc                  RC circuit\n"));
    EXPECT_THAT(list, HasSubstr("09_more                More\n"));
    EXPECT_THAT(list, HasSubstr("04_estimators"));
    EXPECT_THAT(list, Not(HasSubstr("In the second folder")));
    EXPECT_EQ(bench_.shell(own + "$DYNLAB new 08 work && $DYNLAB checks try --lesson 08").exit_code, 0);
    const ChildResult missing = bench_.shell("DYNLAB_LESSONS=nowhere $DYNLAB lessons");
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_THAT(missing.error_output, HasSubstr("DYNLAB_LESSONS: folder not found: 'nowhere'"));
}

// oracle: the points that grade gives where the lesson is known
TEST_F(lessons_anywhere, bring_their_checks_to_students_in_the_bundle) {
    ASSERT_EQ(bench_.dynlab({"bundle", "mine/08_rc"}).exit_code, 0);
    ASSERT_EQ(bench_.shell("mkdir home && cd home && unzip -q ../08_rc.zip && mv ../mine ../away").exit_code, 0);
    EXPECT_EQ(bench_.read("home/08_rc/data/further/further.csv"), "t,u,y\n0,1,2\n0.1,2,4\n");
    bench_.write("home/08_rc/report.md", "---\ntitle: A\n---\n\nThe gain was read off the record of the experiment.\n");
    bench_.write("home/08_rc/analysis.lua", kHeader + kStart + "answer('K', 2.5)\n");
    const ChildResult wrong = bench_.dynlab({"check", "home/08_rc"});
    EXPECT_THAT(wrong.output, HasSubstr("checks of lesson 08_rc: 1 of 5 points"));
    EXPECT_THAT(wrong.output, HasSubstr("check-failed"));
    bench_.write("home/08_rc/analysis.lua", kHeader + kStart + kGain);
    EXPECT_THAT(bench_.dynlab({"check", "home/08_rc"}).output, HasSubstr("checks of lesson 08_rc: 5 of 5 points"));
}

// oracle: the data set that dynlab new writes for the same seed
TEST(bundles, hold_the_records_of_a_group) {
    const Workbench bench;
    bench.write("roster.csv", "id,group,seed\n1,g-7,7\n2,g-7,7\n3,g-8,8\n4,without,\n");
    ASSERT_EQ(bench.dynlab({"new", "03_crane", "work", "--group-seed", "7"}).exit_code, 0);
    ASSERT_EQ(bench.dynlab({"bundle", "03_crane", "--group-seed", "7", "-o", "one.zip"}).exit_code, 0);
    ASSERT_EQ(bench.dynlab({"bundle", "03_crane", "--roster", "roster.csv", "-o", "all"}).exit_code, 0);
    EXPECT_EQ(bench.shell("ls all").output, "03_crane-g-7.zip\n03_crane-g-8.zip\n03_crane-without.zip\nroster.csv\n");
    EXPECT_THAT(bench.read("all/roster.csv"), testing::ContainsRegex("4,,without,[1-9][0-9]*,"));
    EXPECT_EQ(bench.shell("cmp one.zip all/03_crane-g-7.zip").exit_code, 0);
    EXPECT_NE(bench.shell("cmp one.zip all/03_crane-g-8.zip").exit_code, 0);
    bench.shell("mkdir x && cd x && unzip -q ../one.zip");
    EXPECT_EQ(bench.shell("cmp x/03_crane/data/crane/crane.mat work/data/crane/crane.mat").exit_code, 0);
    EXPECT_EQ(bench.shell("ls x/03_crane/data/crane").output, "SOURCE.md\ncrane.mat\n");
    bench.write("roster.csv", "id,group,seed\n1,g-7,7\n2,g-7,8\n");
    EXPECT_THAT(bench.dynlab({"bundle", "03_crane", "--roster", "roster.csv", "-o", "all"}).error_output,
                HasSubstr("the members of g-7 have different seeds"));
}

}  // namespace test_lessons_anywhere
}  // namespace dynlab::test
