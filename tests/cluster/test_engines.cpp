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

/// A class that takes one process some seconds.
constexpr int kSomeSeconds = 40, kTurns = 4'000'000;

/// Some seconds of it.
constexpr const char* kLongStudy = R"(
print(montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(7, 4), Ts = 0.01, sigma = 0.2, runs = 6000, seed = 3,
    estimators = {lssvf = {{2, 1, 0}, 3}, ivsvf = {{2, 1, 0}, 3}}})
)";

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

    bool ended() const { return fs::exists(work_.path("background.code")); }

  private:
    const Workbench& work_;
};

class engines : public testing::Test {
  protected:
    engines() : bench_(kAttackAnswers, kAttackChecks, kAttackSolution) {}

    /// For two minutes, or until there is a file `at_full_speed`, the workers that `grade` starts itself stand still
    /// nine tenths of the time, which their hearts survive: so that work is left for others, however slow the machine
    /// is.
    void slow_workers() {
        work().write("slow.sh",
                     "touch slow; for turn in $(seq 120); do for signal in STOP CONT; do\n"
                     "for p in $(pgrep -f '[d]ynlab work .*shared/.spool'); do\n"
                     "[ \"$(readlink /proc/$p/cwd)\" = \"$PWD\" ] || continue\n"
                     "tr '\\0' ' ' < /proc/$p/cmdline | grep -qE 'node (newer|open|full)' || kill -$signal $p; done\n"
                     "[ $signal = STOP ] && sleep 0.9 || sleep 0.1; done; [ -e at_full_speed ] && exit; done\n");
        work().shell("setsid bash slow.sh > /dev/null 2>&1 < /dev/null & until [ -e slow ]; do sleep 0.02; done");
    }
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
    static std::string command(const std::string& out, const std::string& on, const std::string& before = "",
                               const std::string& more = "") {
        return fmt::format(
            "{} \"$DYNLAB\" grade in --lesson 99 --out {} --isolation {} --no-pdf --timeout 60 --secret secret {} {}",
            before, out, GradingBench::level(), on.empty() ? "" : "--on " + on + " --lease 3", more);
    }
    int grade(const std::string& out, const std::string& on, const std::string& before = "",
              const std::string& more = "") {
        const ChildResult graded = work().shell(command(out, on, before, more));
        said_ = graded.output + graded.error_output;
        return graded.exit_code;
    }
    const Workbench& work() { return bench_.bench(); }
    void wait_for_first_results() {
        work().shell("timeout 60 bash -c 'until [ -n \"$(ls shared/results 2>/dev/null)\" ]; do sleep 0.02; done'");
    }
    /// Ctrl-C for the oldest process of this bench's folder that is called so.
    void interrupt(const std::string& call) {
        work().shell("for p in $(pgrep -f \"" + call +
                     "\"); do [ $(readlink /proc/$p/cwd) = $PWD ] && kill -INT $p; done");
    }

    GradingBench bench_;
    std::string said_;
};

/// With sshd or Slurm, whose ports are theirs alone: one test at a time (tests/CMakeLists.txt).
class loopback : public engines {};
class long_loopback : public engines {};

TEST_F(engines, processes_give_what_one_gives) {
    expect_same("processes:2");
}

TEST_F(loopback, hosts_by_ssh_give_what_one_process_gives) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    expect_same("parallel:1/n1,1/n2", hosts.environment());
}

TEST_F(loopback, slurm_gives_what_one_process_gives) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    expect_same("slurm:tasks=2,partition=short", slurm.environment());
    EXPECT_EQ(work().shell(slurm.environment() + " squeue --noheader").output, "");
}

// What Slurm ends is submitted again; Ctrl-C leaves neither tasks nor workers, and what was done is kept.
TEST_F(loopback, slurm_tasks_that_are_preempted_come_again_and_cancelled_ones_do_not) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    hand_in_class(bench_, kSomeSeconds, kTurns, {});
    ASSERT_EQ(grade("alone", ""), 0);
    const std::string environment = slurm.environment() + " ";
    Background grading(work(), command("shared", "slurm:tasks=1", environment));
    const std::string running =
        "until [ -n \"$(" + environment + "squeue --noheader --states=R --format=%A)\" ]; do sleep 0.1; done; ";
    const auto first = work().shell("timeout 20 bash -c '" + running + "'; " + environment +
                                    "squeue --noheader --states=R --format=%A");
    ASSERT_NE(first.output, "");
    work().shell("sleep 1; " + environment + "scancel " + first.output);
    const auto second = work().shell("timeout 20 bash -c '" + running + "'; " + environment +
                                     "squeue --noheader --states=R --format=%A");
    EXPECT_NE(second.output, "");
    EXPECT_NE(second.output, first.output);
    wait_for_first_results();
    interrupt("[g]rade in --lesson 99 --out shared");
    EXPECT_EQ(grading.wait_for_end(), 130) << work().read("background.txt");
    EXPECT_EQ(work().shell(environment + "squeue --noheader").output, "");
    EXPECT_EQ(workers_of(work()), "");
    ASSERT_EQ(grade("shared", "processes:2"), 0) << said_;
    expect_equal_results(work(), "alone", "shared");
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

TEST_F(engines, a_study_that_was_ended_goes_on_and_is_not_led_twice) {
    work().write("study.lua", kLongStudy);
    const std::string alone = work().shell("\"$DYNLAB\" run study.lua --out alone").output;
    EXPECT_THAT(alone, HasSubstr("lssvf"));
    Background study(work(), "\"$DYNLAB\" study study.lua --on processes:2 --out shared");
    work().shell("timeout 20 bash -c 'until [ -n \"$(ls shared/.spool/results 2>/dev/null)\" ]; do sleep 0.05; done'");
    const ChildResult twice = work().shell("\"$DYNLAB\" study study.lua --on processes:1 --out shared");
    EXPECT_NE(twice.exit_code, 0);
    EXPECT_THAT(twice.error_output, HasSubstr("another dynlab study is at work in"));
    interrupt("[s]tudy study.lua --on processes:2");
    EXPECT_NE(study.wait_for_end(), 0);
    EXPECT_EQ(workers_of(work()), "");
    const auto kept = work().shell("ls shared/.spool/results | wc -l").output;
    EXPECT_NE(kept, "0\n");
    const ChildResult again = work().shell("\"$DYNLAB\" study study.lua --on processes:2 --out shared");
    EXPECT_EQ(again.output, alone) << again.error_output;
    EXPECT_FALSE(fs::exists(work().path("shared/.spool")));
}

// The copy that students get has a link to the course's data; their own links are left out, as by one process.
TEST_F(engines, links_in_submissions_are_what_they_are_to_one_process) {
    bench_.hand_in("linked", "answer('x', #load('data/hairdryer/hairdryer.csv').y)\n");
    bench_.hand_in("sly", "answer('x', load('records.csv').y[1])\n");
    work().shell("ln -s \"$DYNLAB_HOME/data\" in/linked/data; ln -s $PWD/secret in/sly/records.csv");
    expect_same("processes:1");
    EXPECT_THAT(work().read("shared/runs/linked/run.cbor"), Not(HasSubstr("no such file")));
}

// A job that takes its worker with it: the batch that it came in, then it alone, three times each.
TEST_F(engines, a_submission_that_kills_its_worker_three_times_is_left_ungraded_and_named) {
    hand_in_class(bench_, 12, 1000, {});
    bench_.hand_in("killer", "local k = 0\nfor i = 1, 1e8 do k = k + i % 7 end\nanswer('x', 42)\n");
    work().write("in/killer/marker.txt", "");
    fs::create_directory(work().path("tmp"));
    ASSERT_EQ(grade("alone", ""), 0);
    Background grading(work(), command("shared", "processes:1", "TMPDIR=$PWD/tmp"));
    work().shell(
        "until [ -e background.code ]; do if ls tmp/dynlab-*/work/marker.txt > /dev/null 2>&1; then "
        "for w in $(pgrep -f \"[d]ynlab work $PWD/\"); do for h in $(pgrep -P $w -f \"[d]ynlab work\"); do "
        "kill -9 $h && echo $h >> killed.txt; done; done; rm -f tmp/dynlab-*/work/marker.txt; fi; sleep 0.02; done");
    const int code = grading.wait_for_end();
    const std::string said = work().read("background.txt");
    EXPECT_EQ(code, 1) << said;  // one is not graded
    EXPECT_THAT(said, HasSubstr("\"killer\" could not be graded: 3 workers were lost with it: on "));
    EXPECT_THAT(said, HasSubstr("ended with signal 9"));
    EXPECT_EQ(work().shell("wc -l < killed.txt").output, "6\n");
    EXPECT_EQ(work().shell("grep -v killer alone/gradebook.csv").output,
              work().shell("grep -v killer shared/gradebook.csv").output);
    EXPECT_EQ(grade("shared", "processes:1"), 0);  // the next run tries it again
    expect_equal_results(work(), "alone", "shared");
}

TEST_F(engines, a_spool_on_a_full_or_a_read_only_disk_is_named_and_nothing_is_lost) {
    if (work()
            .shell("mkdir small fixed && mount -t tmpfs -o size=96k tmpfs small && "
                   "mount -t tmpfs -o ro,size=1m tmpfs fixed")
            .exit_code != 0)
        GTEST_SKIP() << "no small file system can be mounted here";
    hand_in_class(bench_, 8, 1000, {});
    work().shell("head -c 200000 /dev/urandom > in/s003/noise.bin");
    ASSERT_EQ(grade("alone", ""), 0);
    EXPECT_EQ(grade("shared", "processes:1", "", "--spool fixed/spool"), 1);
    EXPECT_THAT(said_, HasSubstr("read-only file system"));
    grade("shared", "processes:1", "", "--spool small/spool");
    EXPECT_THAT(said_, HasSubstr("no space left on device"));
    EXPECT_THAT(said_, HasSubstr("small/spool"));
    EXPECT_EQ(workers_of(work()), "");
    work().shell("umount -l small fixed");
    ASSERT_EQ(grade("shared", "processes:1"), 0) << said_;
    expect_equal_results(work(), "alone", "shared");
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

TEST_F(loopback, a_host_that_refuses_is_named) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    hand_in_class(bench_, 4, 100, {});
    EXPECT_EQ(grade("o1", "parallel:1/n1,1/closed", hosts.environment()), 0) << said_;
    EXPECT_THAT(said_, HasSubstr("no worker on closed says: ssh: connect to host 127.0.0.1 port"));
    EXPECT_NE(grade("o2", "parallel:1/closed", hosts.environment()), 0);
    EXPECT_THAT(said_, HasSubstr("no worker can be started on any host; closed says: ssh: connect"));
}

TEST_F(loopback, slurm_that_is_down_and_partitions_unknown_are_named) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    hand_in_class(bench_, 1, 100, {});
    EXPECT_NE(grade("o1", "slurm:partition=none", slurm.environment()), 0);
    EXPECT_THAT(said_, HasSubstr("the partitions here are short"));
    slurm.end_controller();
    EXPECT_NE(grade("o2", "slurm:tasks=1", slurm.environment()), 0);
    EXPECT_THAT(said_, HasSubstr("slurmctld is not running or cannot be reached"));
}

TEST_F(engines, a_node_whose_disk_fills_waits_and_another_version_or_no_isolation_is_refused) {
    if (work().shell("mkdir tiny && mount -t tmpfs -o size=600m tmpfs tiny").exit_code != 0)
        GTEST_SKIP() << "no small file system can be mounted here";
    hand_in_class(bench_, kSomeSeconds, kTurns, {});
    ASSERT_EQ(grade("alone", ""), 0);
    Background grading(work(), command("shared", "processes:1"));
    slow_workers();
    work().shell("until [ -e shared/.spool/spool.json ]; do sleep 0.05; done");
    work().shell("cp -rL home newer && echo '-- later' >> newer/lessons/99_small/lesson.lua");
    const ChildResult newer =
        work().shell("DYNLAB_HOME=$PWD/newer timeout 20 \"$DYNLAB\" work shared/.spool --hands 1 --node newer");
    EXPECT_EQ(newer.exit_code, 1);
    EXPECT_THAT(newer.error_output, HasSubstr("newer has another version of dynlab, of its lessons"));
    const bool boxes = std::string(GradingBench::level()) == "full";
    const ChildResult open =
        work().shell("timeout 20 env PATH=$PWD \"$DYNLAB\" work shared/.spool --hands 1 --node open");
    EXPECT_EQ(open.exit_code == 1, boxes) << open.error_output;
    work().shell(
        "TMPDIR=$PWD/tiny setsid timeout 60 \"$DYNLAB\" work shared/.spool --hands 1 --node full > full.txt 2>&1 & "
        "timeout 10 bash -c 'until ls tiny/dynlab-*/work/analysis.lua; do sleep 0.02; done'; cat /dev/zero > "
        "tiny/noise");
    const std::string status = work().shell("sleep 1; \"$DYNLAB\" work --status shared/.spool").output;
    work().write("at_full_speed", "");
    EXPECT_EQ(grading.wait_for_end(), 0) << work().read("background.txt");
    work().shell("umount -l tiny");
    EXPECT_THAT(status, HasSubstr("0 MB left, and 512 are needed"));
    EXPECT_THAT(status, HasSubstr("coordinator: works"));
    EXPECT_THAT(status, HasSubstr("refused: newer has another version"));
    if (boxes) {
        EXPECT_THAT(status, HasSubstr("refused: open: full isolation needs bubblewrap"));
    }
    EXPECT_THAT(work().read("background.txt"), HasSubstr("full waits: "));
    expect_equal_results(work(), "alone", "shared");
}

TEST_F(long_loopback, cancelling_leaves_nothing_running_and_loses_nothing) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    hand_in_class(bench_, kSomeSeconds, kTurns, {});
    ASSERT_EQ(grade("alone", ""), 0);
    Background grading(work(), command("shared", "parallel:1/n1,1/n2", hosts.environment()));
    wait_for_first_results();
    interrupt("[g]rade in --lesson 99 --out shared");
    EXPECT_NE(grading.wait_for_end(), 0);
    EXPECT_THAT(work().read("background.txt"), HasSubstr("interrupted"));
    EXPECT_LT(std::stoi(work().shell("ls shared/results | wc -l").output), kSomeSeconds);
    EXPECT_EQ(workers_of(work()), "");
    ASSERT_EQ(grade("shared", "processes:2"), 0) << said_;
    expect_equal_results(work(), "alone", "shared");
}

}  // namespace test_engines
}  // namespace dynlab::test
