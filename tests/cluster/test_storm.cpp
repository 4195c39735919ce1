// A class while processes are killed at random: workers, the engine's own, the coordinator, which is started again each
// time. In a storm it is 300, every attack of the suite among them, and two hundred are killed. Oracle: what one
// process gives, byte by byte.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <random>
#include <sstream>
#include <thread>

#include "cluster/class_of_attacks.h"
#include "cluster/loopback.h"
#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_storm {

namespace fs = std::filesystem;

constexpr int kSubmissions = 300;

/// How many processes are killed, and how many seconds lie between two.
struct Weather {
    int kills = 0;
    double seconds = 0;
};
constexpr Weather kStorm{200, 1.0};

class gust : public testing::Test {
  protected:
    gust() : bench_(kAttackAnswers, kAttackChecks, kAttackSolution) {}
    const Workbench& work() { return bench_.bench(); }
    std::string command(const std::string& out, const std::string& on) {
        return fmt::format(
            "\"$DYNLAB\" grade in --lesson 99 --out {} --isolation {} --no-pdf --timeout 4 --secret secret {}", out,
            GradingBench::level(), on.empty() ? "" : "--lease 3 --on " + on);
    }
    void start(const std::string& on, const std::string& environment, const std::string& out = "shared") {
        work().write("run.sh", "exec env " + environment + " " + command(out, on) + " >> said.txt 2>&1\n");
        work().shell(
            "rm -f code pid; setsid bash -c 'bash run.sh & echo $! > pid; wait $!; echo $? > code' "
            "> /dev/null 2>&1 < /dev/null & until [ -s pid ]; do sleep 0.02; done");
    }
    void wait_for_end() {
        while (code() < 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    void grade_alone() {
        start("", "", "alone");
        wait_for_end();
        ASSERT_EQ(code(), 0) << work().read("said.txt");
    }
    /// 0 and 1 are ends of its own.
    int code() { return fs::exists(work().path("code")) ? std::atoi(work().read("code").c_str()) : -1; }

    /// `engine` gives the engine's own processes and `mend` starts them again.
    void endure(const std::string& on, const std::string& environment, const Weather& weather,
                const std::function<std::string()>& engine, const std::function<void()>& mend) {
        ASSERT_NO_FATAL_FAILURE(grade_alone());
        std::mt19937 random(1);
        std::uniform_real_distribution<double> share(0, 1);
        start(on, environment);
        int kills = 0, starts = 1;
        while (kills < weather.kills || code() < 0 || code() > 1) {
            if (fs::exists(work().path("code")) && (code() > 1 || kills < weather.kills)) {
                ASSERT_LT(++starts, 100) << work().read("said.txt");
                if (code() <= 1) work().shell("rm -rf shared/results shared/runs");  // done too early: again
                start(on, environment);
            }
            if (kills == weather.kills) {
                std::this_thread::sleep_for(std::chrono::milliseconds(200));
                continue;
            }
            std::this_thread::sleep_for(std::chrono::duration<double>(weather.seconds * (0.4 + 1.2 * share(random))));
            const double what = share(random);
            const std::string pids = what < 0.04 ? work().read("pid") : what < 0.12 ? engine() : workers_of(work());
            std::istringstream words(pids);
            std::vector<pid_t> victims;
            for (pid_t pid; words >> pid;) victims.push_back(pid);
            if (victims.empty()) continue;
            if (::kill(victims[static_cast<std::size_t>(share(random) * 0.999 * static_cast<double>(victims.size()))],
                       SIGKILL) == 0)
                ++kills;
            mend();
        }
        // What a bomb is told, that its memory or its time is over, depends on what else the machine does.
        EXPECT_EQ(work().read("alone/gradebook.csv"), work().read("shared/gradebook.csv"));
        EXPECT_EQ(work().shell("ls alone/results | wc -l").output, work().shell("ls shared/results | wc -l").output);
        EXPECT_EQ(workers_of(work()), "");
        fmt::print("{} kills, the coordinator was started {} times\n", kills, starts);
    }

    GradingBench bench_;
};

TEST_F(gust, over_processes) {
    hand_in_class(bench_, 80, 5'000'000, {});
    endure(
        "processes:2", "", {20, 0.3}, [this] { return workers_of(work()); }, [] {});
}

class storm : public gust {
  protected:
    storm() {
        hand_in_class(bench_, 0, 0, kAttacks);
        hand_in_class(bench_, 0, 0, kEndlessAttacks);
        const auto attacks = static_cast<int>(std::size(kAttacks) + std::size(kEndlessAttacks));
        hand_in_class(bench_, kSubmissions - attacks, 15'000'000, {});
    }
};

TEST_F(storm, over_processes) {
    endure(
        "processes:2", "", kStorm, [this] { return workers_of(work()); }, [] {});
}

TEST_F(storm, over_hosts_by_ssh) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    endure(
        "parallel:1/n1,1/n2", hosts.environment(), kStorm, [&] { return hosts.pids(); },
        [&] { hosts.restart_what_ended(); });
}

TEST_F(storm, over_slurm) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    endure(
        "slurm:tasks=2", slurm.environment(), kStorm, [&] { return slurm.pids(); },
        [&] { slurm.restart_what_ended(); });
}

class long_gust : public gust {};

// All processes of one of two nodes stand still for a minute, then go on with what others have done meanwhile.
TEST_F(long_gust, over_a_node_that_lies_dead_for_a_minute) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    hand_in_class(bench_, 60, 15'000'000, {});
    ASSERT_NO_FATAL_FAILURE(grade_alone());
    start("parallel:1/n1,1/n2", hosts.environment());
    work().shell("timeout 60 bash -c 'until ls shared/.spool/leases 2>/dev/null | grep -q @n1; do sleep 0.05; done'");
    const std::string stopped =
        work()
            .shell(
                "pids=$(for w in $(pgrep -f \"[d]ynlab work $PWD/.*--node n1\"); do echo $w; pgrep -P $w; done); "
                "kill -STOP $pids; echo $pids")
            .output;
    ASSERT_GT(stopped.size(), 1u);
    std::this_thread::sleep_for(std::chrono::seconds(60));
    work().shell("kill -CONT " + stopped.substr(0, stopped.size() - 1));
    wait_for_end();
    EXPECT_EQ(code(), 0) << work().read("said.txt");
    expect_equal_results(work(), "alone", "shared");
    for (int i = 0; i < 100 && !workers_of(work()).empty(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(workers_of(work()), "");
}

}  // namespace test_storm
}  // namespace dynlab::test
