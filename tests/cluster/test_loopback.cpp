// Parts of work by real machines, started here on loopback addresses: GNU parallel with ssh, and Slurm. Oracle: what
// the same class gives when one process grades it alone, byte by byte.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <numeric>
#include <sstream>
#include <thread>

#include "cluster/class_of_attacks.h"
#include "cluster/loopback.h"
#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_loopback {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kStudy = R"(
local M = montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 300, seed = 3,
    estimators = {lssvf = {{2, 1, 0}, 3}, mine = function(d) return lssvf(d, {2, 1, 0}, 2) end}}
print(M)
print(montecarlo{system = tf({2}, {1, 4, 3 + M.lssvf.mean[1]}), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 40,
    seed = 3, estimators = {lssvf = {{2, 1, 0}, 3}}})
)";
constexpr int kClass = 24, kQuick = 50'000, kSlow = 4'000'000;  // turns of a submission's loop

/// Slurm and sshd use fixed ports, so that only one test runs at a time (entries.cmake).
class loopback : public testing::Test {
  protected:
    loopback() : bench_(kAttackAnswers, kAttackChecks, kAttackSolution) {}

    ChildResult grade(const std::string& out, const std::string& more, const std::string& before = "") {
        return work().shell(command(out, more, before));
    }
    static std::string command(const std::string& out, const std::string& more, const std::string& before = "") {
        return fmt::format(
            "{} \"$DYNLAB\" grade in --lesson 99 --out {} --isolation {} --no-pdf --timeout 60 --secret secret {}",
            before, out, GradingBench::level(), more);
    }
    void hand_in_and_grade_alone(int turns) {
        submit_class(bench_, kClass, turns, {});
        ASSERT_EQ(grade("alone", "").exit_code, 0);
    }
    /// Until no job is queued; then the class must be joined.
    void wait_for_slurm(const LoopbackSlurm& slurm) {
        work().shell("timeout 300 bash -c 'while [ -n \"$(" + slurm.environment() +
                     " squeue --noheader)\" ]; do sleep 0.2; done'");
    }
    std::string logs() { return work().shell("cat shared/parts/slurm-*.txt").output; }
    /// Submissions that the parts say they graded.
    int graded_by_parts() {
        std::istringstream numbers(
            work().shell("sed -n 's/^part .*: \\([0-9]*\\) graded now.*/\\1/p' shared/parts/slurm-*.txt").output);
        return std::accumulate(std::istream_iterator<int>(numbers), std::istream_iterator<int>(), 0);
    }
    void wait_for_first_results() {
        work().shell("timeout 60 bash -c 'until ls shared/results/*/results.json; do sleep 0.02; done'");
    }
    const Workbench& work() { return bench_.bench(); }

    GradingBench bench_;
};

TEST_F(loopback, hosts_by_ssh_give_what_one_process_gives) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    ASSERT_NO_FATAL_FAILURE(hand_in_and_grade_alone(kQuick));
    const ChildResult graded = grade("shared", "--on hosts:1/n1,1/n2", hosts.environment());
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_THAT(graded.output, HasSubstr("24 submissions: 0 graded now, 24 unchanged"));
    expect_equal_results(work(), "alone", "shared");
    EXPECT_THAT(work().read("shared/parts/joblog"), AllOf(HasSubstr("n1"), HasSubstr("n2")));
}

TEST_F(loopback, a_host_that_refuses_leaves_its_parts_to_others_and_alone_is_named) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    ASSERT_NO_FATAL_FAILURE(hand_in_and_grade_alone(kQuick));
    EXPECT_EQ(grade("shared", "--on hosts:1/n1,1/closed", hosts.environment()).exit_code, 0);
    expect_equal_results(work(), "alone", "shared");
    const ChildResult refused = grade("other", "--on hosts:1/closed", hosts.environment());
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.error_output, HasSubstr("ssh: connect to host 127.0.0.1 port 22023"));
}

TEST_F(loopback, ctrl_c_ends_what_other_hosts_do_and_the_same_command_continues) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    ASSERT_NO_FATAL_FAILURE(hand_in_and_grade_alone(kSlow));
    work().write("background.sh", command("shared", "--on hosts:1/n1,1/n2", hosts.environment() + " exec"));
    work().shell(
        "setsid bash -c 'bash background.sh & echo $! > pid; wait $!; echo $? > code' > /dev/null 2>&1 < /dev/null & "
        "until [ -s pid ]; do sleep 0.02; done");
    wait_for_first_results();
    work().shell(
        "kill -INT $(pgrep -f '[g]rade in --lesson 99 --out shared' | head -1); "
        "timeout 30 bash -c 'until [ -s code ]; do sleep 0.05; done'; sleep 2");
    EXPECT_EQ(work().read("code"), "130\n");
    EXPECT_EQ(workers_of(work()), "");
    EXPECT_FALSE(fs::exists(work().path("shared/gradebook.csv")));
    ASSERT_EQ(grade("shared", "--on hosts:1/n1,1/n2", hosts.environment()).exit_code, 0);
    expect_equal_results(work(), "alone", "shared");
}

TEST_F(loopback, slurm_gives_what_one_process_gives_and_grades_nothing_twice) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    ASSERT_NO_FATAL_FAILURE(hand_in_and_grade_alone(kQuick));
    const ChildResult submitted = grade("shared", "--on slurm:tasks=3,partition=short", slurm.environment());
    ASSERT_EQ(submitted.exit_code, 0) << submitted.error_output;
    EXPECT_THAT(submitted.output, AllOf(HasSubstr("squeue --jobs="), HasSubstr("scancel ")));
    const ChildResult again = grade("shared", "--on slurm:tasks=3", slurm.environment());
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_THAT(again.error_output, HasSubstr("are still queued or running"));
    wait_for_slurm(slurm);
    expect_equal_results(work(), "alone", "shared");
    EXPECT_EQ(graded_by_parts(), kClass);
    EXPECT_THAT(logs(), HasSubstr("24 submissions: 0 graded now, 24 unchanged"));
}

TEST_F(loopback, a_killed_task_runs_again) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    ASSERT_NO_FATAL_FAILURE(hand_in_and_grade_alone(kSlow));
    ASSERT_EQ(grade("shared", "--on slurm:tasks=2", slurm.environment()).exit_code, 0);
    wait_for_first_results();
    const std::string workers = workers_of(work());
    ASSERT_NE(workers, "");
    work().shell("kill -KILL " + workers.substr(0, workers.find('\n')));
    wait_for_slurm(slurm);
    EXPECT_THAT(logs(), HasSubstr("Killed"));
    expect_equal_results(work(), "alone", "shared");
    EXPECT_LE(graded_by_parts(), kClass);  // what the killed one had done was not done again
}

TEST_F(loopback, a_canceled_array_can_be_continued) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    ASSERT_NO_FATAL_FAILURE(hand_in_and_grade_alone(kSlow));
    ASSERT_EQ(grade("shared", "--on slurm:tasks=2", slurm.environment()).exit_code, 0);
    wait_for_first_results();
    work().shell(slurm.environment() + " scancel $(tr ',' ' ' < shared/parts/slurm-jobs)");
    wait_for_slurm(slurm);
    EXPECT_FALSE(fs::exists(work().path("shared/gradebook.csv")));
    EXPECT_LT(std::stoi(work().shell("ls shared/results | wc -l").output), kClass);
    EXPECT_EQ(workers_of(work()), "");
    ASSERT_EQ(grade("shared", "--on slurm:tasks=2", slurm.environment()).exit_code, 0);
    wait_for_slurm(slurm);
    expect_equal_results(work(), "alone", "shared");
}

TEST_F(loopback, slurm_that_is_down_and_partitions_unknown_are_named) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    submit_class(bench_, 1, 100, {});
    EXPECT_THAT(grade("o1", "--on slurm:partition=none", slurm.environment()).error_output,
                HasSubstr("the partitions of this cluster are short"));
    slurm.end_controller();
    EXPECT_THAT(grade("o2", "--on slurm:tasks=1", slurm.environment()).error_output,
                HasSubstr("slurmctld is not running or cannot be reached"));
}

TEST_F(loopback, programs_that_lack_are_named_with_their_package) {
    submit_class(bench_, 1, 100, {});
    bench_.bench().hide_program("sbatch");
    const ChildResult refused = grade("o1", "--on slurm:tasks=1");
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.error_output, HasSubstr("slurm-client"));
}

TEST_F(loopback, a_study_of_two_calls_gives_what_one_run_gives) {
    LoopbackHosts hosts;
    LoopbackSlurm slurm;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    work().write("study.lua", kStudy);
    const ChildResult alone = work().shell("\"$DYNLAB\" run study.lua --out alone");
    ASSERT_EQ(alone.exit_code, 0) << alone.error_output;
    const ChildResult shared =
        work().shell(hosts.environment() + " \"$DYNLAB\" study study.lua --out hosts --on hosts:1/n1,1/n2");
    EXPECT_EQ(shared.output, alone.output) << shared.error_output;
    ASSERT_EQ(work()
                  .shell(slurm.environment() + " \"$DYNLAB\" study study.lua --out slurm --on slurm:tasks=2,rounds=2")
                  .exit_code,
              0);
    wait_for_slurm(slurm);
    EXPECT_EQ(work().shell("cat slurm/parts/slurm-join-*.txt").output, alone.output);
}

}  // namespace test_loopback
}  // namespace dynlab::test
