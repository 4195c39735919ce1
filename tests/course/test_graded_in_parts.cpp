// A class that is graded in parts, each by a separate process. Oracle: the files that a single process makes, byte by
// byte.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_graded_in_parts {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class graded_in_parts : public testing::Test {
  protected:
    graded_in_parts()
        : bench_("--   x: number\n", "check{id = 'x', test = function(a) return near(a.x, 42, {rel = 0.01}) end}\n",
                 "answer('x', 42)\n") {
        for (int i = 1; i <= 5; ++i)
            bench_.submit_file(fmt::format("s{}", i), fmt::format("answer('x', {})\n", 40 + i));
        bench_.submit_file("broken", "error('no')\n");
        work().write("in/nothing/notes.txt", "no script");
    }
    const Workbench& work() { return bench_.bench(); }
    ChildResult grade(const std::string& out, const std::string& more = "") {
        return work().shell(fmt::format("\"$DYNLAB\" grade in --lesson 99 --out {} --isolation {} --no-pdf {}", out,
                                        GradingBench::level(), more));
    }
    GradingBench bench_;
};

TEST_F(graded_in_parts, parts_give_what_one_process_gives_and_nothing_is_graded_twice) {
    ASSERT_EQ(grade("alone").exit_code, 1);  // one is unreadable
    EXPECT_THAT(grade("shared", "--part 1/2").output, HasSubstr("part 1/2: 4 graded now, 0 unchanged"));
    EXPECT_FALSE(fs::exists(work().path("shared/gradebook.csv")));
    const ChildResult early = grade("shared", "--join");
    EXPECT_EQ(early.exit_code, 1);
    EXPECT_THAT(early.error_output, AllOf(HasSubstr("1 part of 2 cannot be joined"), HasSubstr("--part 2/2")));
    EXPECT_THAT(grade("shared", "--part 2/2").output, HasSubstr("part 2/2: 3 graded now, 0 unchanged"));
    EXPECT_THAT(grade("shared", "--part 1/2").output, HasSubstr("part 1/2: 0 graded now, 4 unchanged"));
    EXPECT_THAT(grade("shared", "--join").output, HasSubstr("7 submissions: 0 graded now, 7 unchanged"));
    EXPECT_EQ(work().read("alone/gradebook.csv"), work().read("shared/gradebook.csv"));
    EXPECT_EQ(work().read("alone/summary.md"), work().read("shared/summary.md"));
    EXPECT_EQ(work()
                  .shell("diff -rq alone/results shared/results; diff -rq -x .worked_solution.cbor alone/runs "
                         "shared/runs")
                  .output,
              "");
}

TEST_F(graded_in_parts, results_of_another_version_are_not_joined) {
    work().shell("cp -rL home newer && echo '-- later' >> newer/lessons/99_small/lesson.lua");
    grade("shared", "--part 1/2");
    bench_.bench().set_home(work().path("newer"));
    grade("shared", "--part 2/2");
    bench_.bench().set_home(work().path("home"));
    const ChildResult joined = grade("shared", "--join");
    EXPECT_EQ(joined.exit_code, 1);
    EXPECT_THAT(joined.error_output, AllOf(HasSubstr("another version of dynlab"), HasSubstr("--part 2/2")));
    EXPECT_FALSE(fs::exists(work().path("shared/gradebook.csv")));
}

TEST_F(graded_in_parts, a_machine_without_isolation_refuses_its_part) {
    if (std::string(GradingBench::level()) != "full") GTEST_SKIP() << "this machine has no full isolation";
    bench_.bench().hide_program("bwrap");
    const ChildResult refused = grade("shared", "--part 1/2");
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_THAT(refused.error_output, HasSubstr("bubblewrap"));
    EXPECT_EQ(work().shell("ls shared/results 2>/dev/null").output, "");
}

// oracle: the names of the folders; GNU parallel gives such words a special meaning
TEST_F(graded_in_parts, braces_in_names_reach_the_parts_as_they_are) {
    if (work().shell("parallel --version").exit_code != 0) GTEST_SKIP() << "GNU parallel is missing";
    work().shell("mv in '{#} {}' && mkdir in && mv '{#} {}'/s* in && mv in '{1}{.}'");
    const ChildResult graded = work().shell(
        fmt::format("\"$DYNLAB\" grade '{{1}}{{.}}' --lesson 99 --out 'o{{}}' --isolation {} --no-pdf --on processes:1",
                    GradingBench::level()));
    EXPECT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_THAT(graded.output, HasSubstr("5 submissions: 0 graded now, 5 unchanged"));
}

TEST_F(graded_in_parts, options_that_do_not_fit_together_are_refused) {
    EXPECT_EQ(grade("o", "--part 3/2").exit_code, 2);
    EXPECT_EQ(grade("o", "--part 1/2 --join").exit_code, 2);
    EXPECT_EQ(grade("o", "--part 1/2 --regrade").exit_code, 2);
    EXPECT_THAT(grade("o", "--on cloud:9").error_output, HasSubstr("must be slurm"));
}

}  // namespace test_graded_in_parts
}  // namespace dynlab::test
