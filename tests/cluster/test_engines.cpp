// The real engines, started here on loopback addresses: processes, ssh with GNU parallel, Slurm. Oracle: what the same
// class gives when one process grades it alone, byte by byte.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <optional>
#include <thread>

#include "cluster/class_of_attacks.h"
#include "cluster/loopback.h"
#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_engines {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kStudy = R"(
local M = montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 300, seed = 3,
    estimators = {lssvf = {{2, 1, 0}, 3}, mine = function(d) return lssvf(d, {2, 1, 0}, 2) end}}
print(M)
local u = prbs(4, 100)
local d = iddata(lsim(tf({2}, {1, 4, 3}), u, 0.01) + 0.02*M.lssvf.mean[1]*randn(#u), u, 0.01)
print(selcstruc(srivcstruc(d, {poles = {1, 3}, zeros = {0, 2}})))
)";

class engines : public testing::Test {
  protected:
    engines() : bench_(kAttackAnswers, kAttackChecks, kAttackSolution) {}

    /// Graded alone, then by `on`: marks, messages and figures of the class must be equal to the last byte.
    void expect_same(const std::string& on, const std::string& before = "") {
        hand_in_class(bench_, 24, 50'000, {});
        ASSERT_EQ(grade("alone", ""), 0);
        ASSERT_EQ(grade("shared", on, before), 0) << said_;
        expect_equal_results(work(), "alone", "shared");
        EXPECT_FALSE(fs::exists(work().path("shared/.spool")));
        EXPECT_FALSE(fs::exists(work().path("shared/.spool.key")));
        EXPECT_EQ(workers_of(work()), "");
    }
    int grade(const std::string& out, const std::string& on, const std::string& before = "",
              const std::string& more = "") {
        const ChildResult graded = work().shell(fmt::format(
            "{} \"$DYNLAB\" grade in --lesson 99 --out {} --isolation {} --no-pdf --timeout 10 --secret secret "
            "{} {}",
            before, out, GradingBench::level(), on.empty() ? "" : "--on " + on + " --lease 3", more));
        said_ = graded.output + graded.error_output;
        return graded.exit_code;
    }
    const Workbench& work() { return bench_.bench(); }

    GradingBench bench_;
    std::string said_;
};

TEST_F(engines, processes_give_what_one_gives) {
    expect_same("processes:2");
}

TEST_F(engines, hosts_by_ssh_give_what_one_process_gives) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    expect_same("parallel:1/n1,1/n2", hosts.environment());
}

TEST_F(engines, slurm_gives_what_one_process_gives) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    expect_same("slurm:tasks=2,partition=short", slurm.environment());
    EXPECT_EQ(work().shell(slurm.environment() + " squeue --noheader").output, "");
}

TEST_F(engines, a_study_has_the_same_numbers_for_every_split) {
    work().write("study.lua", kStudy);
    const auto numbers = [&](const std::string& command) {
        const ChildResult ran = work().shell("\"$DYNLAB\" " + command + " | grep -v '^figure'");
        EXPECT_EQ(ran.error_output, "");
        return ran.output;
    };
    const std::string alone = numbers("run study.lua --out alone");
    EXPECT_THAT(alone, HasSubstr("lssvf"));
    EXPECT_EQ(numbers("study study.lua --on processes:1 --out one"), alone);
    EXPECT_EQ(numbers("study study.lua --on processes:3 --out three"), alone);
    EXPECT_EQ(workers_of(work()), "");
}

TEST_F(engines, what_is_not_there_is_named_with_its_remedy) {
    hand_in_class(bench_, 1, 100, {});
    EXPECT_NE(grade("o1", "cloud:9"), 0);
    EXPECT_THAT(said_, HasSubstr("--on \"cloud:9\" is none of processes:N"));
    EXPECT_NE(grade("o2", "parallel:-oProxyCommand=x"), 0);
    EXPECT_THAT(said_, HasSubstr("is no host"));
    EXPECT_NE(grade("o3", "slurm:tasks=0"), 0);
    EXPECT_THAT(said_, HasSubstr("tasks=N and hands=N"));
    EXPECT_NE(grade("o4", "processes:1", "", "--spool /proc/spool"), 0);
    EXPECT_THAT(said_, HasSubstr("cannot write"));
    // Another course's spool.
    work().shell(
        "mkdir -p other && echo '{\"purpose\": \"grade 01 into /x\", \"key\": \"/x/key\"}' > other/spool.json");
    EXPECT_NE(grade("o5", "processes:1", "", "--spool other"), 0);
    EXPECT_THAT(said_, HasSubstr("belongs to other work"));
    EXPECT_THAT(work().dynlab({"work", "nowhere"}).error_output, HasSubstr("there is no spool"));
}

TEST_F(engines, programs_that_lack_are_named_with_their_package) {
    hand_in_class(bench_, 1, 100, {});
    bench_.bench().hide_program("sbatch");
    EXPECT_EQ(grade("o1", "slurm:tasks=1"), 3);
    EXPECT_THAT(said_, HasSubstr("slurm-client"));
}

TEST_F(engines, a_host_that_refuses_is_named) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    hand_in_class(bench_, 4, 100, {});
    EXPECT_EQ(grade("o1", "parallel:1/n1,1/closed", hosts.environment()), 0) << said_;
    EXPECT_THAT(said_, HasSubstr("no worker on closed says: ssh: connect to host 127.0.0.1 port"));
    EXPECT_NE(grade("o2", "parallel:1/closed", hosts.environment()), 0);
    EXPECT_THAT(said_, HasSubstr("no worker can be started on any host; closed says: ssh: connect"));
}

TEST_F(engines, slurm_that_is_down_and_partitions_unknown_are_named) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    hand_in_class(bench_, 1, 100, {});
    EXPECT_NE(grade("o1", "slurm:partition=none", slurm.environment()), 0);
    EXPECT_THAT(said_, HasSubstr("the partitions here are short"));
    slurm.end_controller();
    EXPECT_NE(grade("o2", "slurm:tasks=1", slurm.environment()), 0);
    EXPECT_THAT(said_, HasSubstr("slurmctld is not running or cannot be reached"));
}

/// Work that lasts until it is ended, watched from outside.
class Background {
  public:
    Background(const Workbench& work, const std::string& command) : work_(work) {
        work.write("background.sh", command + " > background.txt 2>&1\necho $? > background.code\n");
        work.shell(
            "setsid bash background.sh > /dev/null 2>&1 < /dev/null & "
            "until [ -e background.txt ]; do sleep 0.02; done");
    }
    int wait_for_end() {
        for (int i = 0; i < 2400 && !fs::exists(work_.path("background.code")); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return fs::exists(work_.path("background.code")) ? std::stoi(work_.read("background.code")) : -1;
    }

  private:
    const Workbench& work_;
};

TEST_F(engines, a_node_without_room_waits_and_another_version_is_refused) {
    if (work().shell("mkdir tiny && mount -t tmpfs -o size=1m tmpfs tiny").exit_code != 0)
        GTEST_SKIP() << "no small file system can be mounted here";
    hand_in_class(bench_, 40, 15'000'000, {});
    ASSERT_EQ(grade("alone", ""), 0);
    Background grading(work(),
                       "\"$DYNLAB\" grade in --lesson 99 --out shared --no-pdf --timeout 10 --secret secret "
                       "--isolation " +
                           GradingBench::level() + " --on processes:1 --lease 3");
    work().shell("until [ -e shared/.spool/spool.json ]; do sleep 0.05; done");
    work().shell("cp -rL home newer && echo '-- later' >> newer/lessons/99_small/lesson.lua");
    const ChildResult newer =
        work().shell("DYNLAB_HOME=$PWD/newer timeout 20 \"$DYNLAB\" work shared/.spool --hands 1 --node newer");
    EXPECT_EQ(newer.exit_code, 1);
    EXPECT_THAT(newer.error_output, HasSubstr("newer has another version of dynlab, of its lessons"));
    work().shell(
        "TMPDIR=$PWD/tiny setsid timeout 60 \"$DYNLAB\" work shared/.spool --hands 1 --node full > full.txt 2>&1 & "
        "sleep 0.5");
    const std::string status = work().shell("sleep 2; \"$DYNLAB\" work --status shared/.spool").output;
    EXPECT_EQ(grading.wait_for_end(), 0) << work().read("background.txt");
    work().shell("umount -l tiny");
    EXPECT_THAT(status, HasSubstr("1 MB left, and 512 are needed"));
    EXPECT_THAT(status, HasSubstr("coordinator: works"));
    EXPECT_THAT(status, HasSubstr("refused: newer has another version"));
    EXPECT_THAT(work().read("background.txt"), HasSubstr("full waits: "));
    EXPECT_THAT(work().shell("cat shared/logs/*/log.txt").output, Not(HasSubstr("on full,")));
    expect_equal_results(work(), "alone", "shared");
}

TEST_F(engines, cancelling_leaves_nothing_running_and_loses_nothing) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    hand_in_class(bench_, 120, 15'000'000, {});
    ASSERT_EQ(grade("alone", ""), 0);
    const ChildResult cancelled = work().shell(hosts.environment() +
                                               " timeout --signal=INT 7 \"$DYNLAB\" grade in --lesson 99 --out shared "
                                               "--no-pdf --timeout 10 --secret secret --isolation " +
                                               GradingBench::level() + " --on parallel:1/n1,1/n2 --lease 3");
    EXPECT_THAT(cancelled.error_output, HasSubstr("interrupted"));
    EXPECT_EQ(workers_of(work()), "");
    ASSERT_EQ(grade("shared", "processes:2"), 0) << said_;
    expect_equal_results(work(), "alone", "shared");
}

}  // namespace test_engines
}  // namespace dynlab::test
