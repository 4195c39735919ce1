// A class while processes are killed at random: those that grade a part, the scheduler's own, the command itself, which
// is started again each time. In a storm there are 300 submissions, every attack of the suite among them, and two
// hundred are killed. Oracle: what one process gives, byte by byte.
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
            GradingBench::level(), on.empty() ? "" : "--on " + on);
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
    /// The exit code of the command, or -1 if there is none yet. Regular exits have the codes 0 and 1.
    int code() { return fs::exists(work().path("code")) ? std::atoi(work().read("code").c_str()) : -1; }

    /// `scheduler` gives the scheduler's own processes, `restart` starts them again, `busy` says whether it has work.
    void endure(const std::string& on, const std::string& environment, const Weather& weather,
                const std::function<std::string()>& scheduler, const std::function<void()>& restart,
                const std::function<bool()>& busy) {
        ASSERT_NO_FATAL_FAILURE(grade_alone());
        std::mt19937 random(1);
        std::uniform_real_distribution<double> share(0, 1);
        const auto joined = [&] { return fs::exists(work().path("shared/gradebook.csv")); };
        int kills = 0, starts = 0;
        while (kills < weather.kills || !joined()) {
            if (joined()) work().shell("rm -rf shared/results shared/runs shared/gradebook.csv");  // too early: again
            if ((starts == 0 || code() >= 0) && !busy()) {
                ASSERT_LT(++starts, 200) << work().read("said.txt");
                start(on, environment);
            }
            std::this_thread::sleep_for(std::chrono::duration<double>(weather.seconds * (0.4 + 1.2 * share(random))));
            if (kills == weather.kills) continue;
            const double what = share(random);
            const std::string pids = what < 0.04 ? work().read("pid") : what < 0.12 ? scheduler() : workers_of(work());
            std::istringstream words(pids);
            std::vector<pid_t> victims;
            for (pid_t pid; words >> pid;) victims.push_back(pid);
            if (victims.empty()) continue;
            if (::kill(victims[static_cast<std::size_t>(share(random) * 0.999 * static_cast<double>(victims.size()))],
                       SIGKILL) == 0)
                ++kills;
            restart();
        }
        while (busy()) std::this_thread::sleep_for(std::chrono::milliseconds(200));
        // The message for a bomb, about its memory or its time, depends on the load of the machine and is not compared.
        EXPECT_EQ(work().read("alone/gradebook.csv"), work().read("shared/gradebook.csv"));
        EXPECT_EQ(work().shell("ls alone/results | wc -l").output, work().shell("ls shared/results | wc -l").output);
        fmt::print("{} kills, the command was started {} times\n", kills, starts);
    }

    GradingBench bench_;
};

TEST_F(gust, over_processes) {
    if (const std::string lacking = lacking_program({"parallel"}); !lacking.empty()) GTEST_SKIP() << lacking;
    submit_class(bench_, 80, 5'000'000, {});
    endure(
        "processes:2", "", {20, 0.3}, [this] { return workers_of(work()); }, [] {}, [] { return false; });
}

class storm : public gust {
  protected:
    storm() {
        submit_class(bench_, 0, 0, kAttacks);
        submit_class(bench_, 0, 0, kEndlessAttacks);
        const auto attacks = static_cast<int>(std::size(kAttacks) + std::size(kEndlessAttacks));
        submit_class(bench_, kSubmissions - attacks, 15'000'000, {});
    }
};

TEST_F(storm, over_hosts_by_ssh) {
    LoopbackHosts hosts;
    if (!hosts.reason_to_skip().empty()) GTEST_SKIP() << hosts.reason_to_skip();
    endure(
        "hosts:1/n1,1/n2", hosts.environment(), kStorm, [&] { return hosts.pids(); },
        [&] { hosts.restart_what_ended(); }, [] { return false; });
}

TEST_F(storm, over_slurm) {
    LoopbackSlurm slurm;
    if (!slurm.reason_to_skip().empty()) GTEST_SKIP() << slurm.reason_to_skip();
    endure(
        "slurm:tasks=2", slurm.environment(), kStorm, [&] { return slurm.pids(); }, [&] { slurm.restart_what_ended(); },
        [&] { return !work().shell(slurm.environment() + " squeue --noheader").output.empty(); });
}

}  // namespace test_storm
}  // namespace dynlab::test
