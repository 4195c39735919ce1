// A script that runs again and again while the user writes it. Oracles: the counts that cells write to a file at each
// run, and the results of a run of the complete script.
#include "app/live/script_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>

#include <fstream>
#include <thread>

#include "app/live/folder_watch.h"
#include "platform/temporary_folder.h"

namespace test_script_runner {
using namespace dynlab;
using testing::ElementsAre;
namespace fs = std::filesystem;

class script_runner : public testing::Test {
  protected:
    PercentScript script(const std::string& source) const {
        return parse_percent_script(source, folder.path() / "analysis.lua");
    }

    void order(const std::string& source, std::uint32_t seed = 1, const std::set<fs::path>& changed = {}) {
        ReportRequest request;
        request.script = script(source);
        request.seed = seed;
        request.slider_values = sliders;
        runner.run(request, folder.path(), changed);
    }

    /// Runs to the end; the parts that ran.
    std::vector<std::size_t> run(const std::string& source, const std::set<fs::path>& changed = {}) {
        std::vector<std::size_t> ran;
        order(source, 1, changed);
        while (runner.running()) {
            RunnerNews news = runner.next();
            if (news.kind == "begun") ran.push_back(news.part);
            if (news.kind == "done" || news.record.error) record = std::move(news.record);
        }
        return ran;
    }

    std::string printed(const std::string& cell) const {
        const auto outputs = record.outputs.find(cell);
        return outputs == record.outputs.end() ? "" : outputs->second.front().printed;
    }

    TemporaryFolder folder;
    ScriptRunner runner;
    std::map<std::string, double> sliders;
    RunRecord record;
};

/// Cells that take longer than it is worth to keep what was before.
const std::string kWork = "local function work() local s = 0 for i = 1, 1e6 do s = s + i end return s end\n";
const std::string kA = "-- %% id=a\n" + kWork + "local x = 1\nwork()\n",
                  kB = "-- %% id=b\nx = x + 1\nwork()\nprint(x)\n", kC = "-- %% id=c\nwork()\nprint(x * 10)\n";

TEST_F(script_runner, runs_only_from_the_first_change_on) {
    EXPECT_THAT(run(kA + kB + kC), ElementsAre(0, 1, 2));
    EXPECT_EQ(printed("c"), "20\n");
    EXPECT_THAT(run(kA + kB + "-- %% id=c\nprint(x * 100)\n"), ElementsAre(2));
    EXPECT_EQ(printed("c"), "200\n");
    EXPECT_EQ(printed("b"), "2\n");
    EXPECT_THAT(run(kA + "-- %% id=b\nx = x + 2\nprint(x)\n" + kC), ElementsAre(1, 2));
    EXPECT_EQ(printed("c"), "30\n");
}

/// The runner answers questions during typing from the state after the last cell. The answers change nothing.
TEST_F(script_runner, questions_are_answered_from_the_state_that_the_script_left) {
    const auto answer = [&](const std::string& question, const std::string& text) {
        RunOrder order;
        order.question = question, order.text = text;
        return runner.ask(order);
    };
    EXPECT_EQ(answer("variables", ""), "[]");
    run(kA + kB);
    EXPECT_THAT(answer("variables", ""), testing::HasSubstr(R"("name":"x","size":"","text":"2")"));
    EXPECT_THAT(answer("complete", "print(wo"), testing::HasSubstr(R"("text":"work")"));
    EXPECT_THAT(answer("help", "x"), testing::HasSubstr("2"));
    EXPECT_THAT(run(kA + kB + kC), ElementsAre(2)) << "the state is as it was";
    order(kA + "-- %% id=b\nx = 5\nwhile true do end\n");
    while (runner.running() && runner.next().kind != "split") {
    }
    EXPECT_THAT(answer("variables", ""), testing::HasSubstr("\"x\"")) << "while a part runs, from the state before";
    runner.stop();
}

TEST_F(script_runner, a_run_ends_with_the_cell_that_was_asked_for_or_begins_with_it_again) {
    ReportRequest request;
    request.script = script(kA + kB + kC);
    const auto ran = [&](const ScriptRunner::RunExtent& extent) {
        std::vector<std::size_t> parts;
        runner.run(request, folder.path(), {}, extent);
        while (runner.running())
            if (const RunnerNews news = runner.next(); news.kind == "begun") parts.push_back(news.part);
        return parts;
    };
    EXPECT_THAT(ran({.again = "", .until = "b"}), ElementsAre(0, 1));
    EXPECT_FALSE(runner.finished());
    EXPECT_THAT(ran({.again = "", .until = "a"}), ElementsAre()) << "it has run";
    EXPECT_THAT(ran({}), ElementsAre(2));
    EXPECT_TRUE(runner.finished());
    EXPECT_THAT(ran({.again = "b", .until = ""}), ElementsAre(1, 2));
}

TEST_F(script_runner, text_alone_runs_nothing) {
    run(kA + kB);
    EXPECT_THAT(run("-- %% [markdown]\n-- Text.\n\n" + kA + kB), ElementsAre());
    EXPECT_THAT(run(kA + kB + kC), ElementsAre(2));
}

/// A moved slider runs its cell and the cells after it. A slider at the value set by the script runs nothing.
TEST_F(script_runner, a_slider_runs_only_from_its_cell_on) {
    const std::string source = kA + "-- %% id=b\nlocal k = slider(\"k\", 3, 1, 10)\nwork()\nprint(k)\n" +
                               "-- %% id=c\nwork()\nprint(k * 10)\n";
    EXPECT_THAT(run(source), ElementsAre(0, 1, 2));
    EXPECT_EQ(printed("c"), "30\n");
    sliders["k"] = 4;
    EXPECT_THAT(run(source), ElementsAre(1, 2));
    EXPECT_EQ(printed("b"), "4\n");
    EXPECT_EQ(printed("c"), "40\n");
    EXPECT_EQ(record.sliders.at("k").initial, 3);
    EXPECT_EQ(record.sliders.at("k").cell, "b");
    EXPECT_THAT(run(source), ElementsAre());
    sliders["other"] = 7;
    EXPECT_THAT(run(source), ElementsAre());
    sliders.clear();
    EXPECT_THAT(run(source), ElementsAre(1, 2));
    EXPECT_EQ(printed("b"), "3\n");
}

/// Moved again while what it started is still under way.
TEST_F(script_runner, a_slider_moved_during_a_run_counts) {
    const std::string source = kA +
                               "-- %% id=b\nlocal k = slider(\"k\", 1, 1, 10)\n"
                               "if k < 5 then while true do end end\nprint(k)\n";
    order(source);
    sliders["k"] = 8;
    run(source);
    EXPECT_EQ(printed("b"), "8\n");
}

TEST_F(script_runner, goes_on_behind_a_failure) {
    EXPECT_THAT(run(kA + kB + "-- %% id=c\nerror(\"no\")\n"), ElementsAre(0, 1, 2));
    ASSERT_TRUE(record.error);
    EXPECT_THAT(record.error->text(), testing::HasSubstr("no"));
    EXPECT_EQ(printed("b"), "2\n");
    EXPECT_THAT(run(kA + kB + kC), ElementsAre(2));
    EXPECT_FALSE(record.error);
    EXPECT_EQ(printed("c"), "20\n");
}

TEST_F(script_runner, a_file_that_has_changed_is_read_again) {
    std::ofstream(folder.path() / "d.csv") << "t,u,y\n0,1,1\n1,1,2\n";
    const std::string source = kA + "-- %% id=b\nlocal d = load(\"d.csv\")\nprint(d.y[2])\n" + kC;
    run(source);
    EXPECT_EQ(printed("b"), "2\n");
    std::ofstream(folder.path() / "d.csv") << "t,u,y\n0,1,1\n1,1,3\n";
    ASSERT_FALSE(record.files_read.empty());
    EXPECT_THAT(run(source, {place_of(record.files_read.front())}), ElementsAre(1, 2));
    EXPECT_EQ(printed("b"), "3\n");
}

TEST_F(script_runner, another_seed_or_a_shorter_script_are_changes) {
    run(kA + kB + kC);
    EXPECT_THAT(run(kA + kB), ElementsAre());
    order(kA + kB, 2);
    EXPECT_TRUE(runner.running());
    EXPECT_EQ(runner.next().kind, "split");
    EXPECT_EQ(runner.next().part, 0u);
}

TEST_F(script_runner, an_endless_loop_is_stopped_and_the_next_run_goes_on_before_it) {
    run(kA + kB + kC);
    const std::string endless = kA + kB + "-- %% id=c\nwhile true do end\n";
    order(endless);
    while (runner.next().kind != "begun") {
    }
    pollfd waiting{runner.descriptor(), POLLIN, 0};
    EXPECT_EQ(::poll(&waiting, 1, 100), 0);  // it runs
    runner.stop();
    EXPECT_FALSE(runner.running());
    EXPECT_EQ(runner.descriptor(), -1);
    const std::vector<std::size_t> ran = run(kA + kB + kC);
    EXPECT_EQ(ran.back(), 2u);
    EXPECT_EQ(printed("c"), "20\n");
    order(endless);
    EXPECT_THAT(run(kA + kB + "-- %% id=c\nprint(\"new\")\n"), ElementsAre(2));  // a new text stops it, too
    EXPECT_EQ(printed("c"), "new\n");
}

/// A process that runs out of memory or is killed ends its run. The next run still starts.
TEST_F(script_runner, survives_the_death_of_its_processes) {
    order(kA + kB + "-- %% id=c\nwhile true do end\n");
    pid_t process = 0;
    for (std::size_t begun = 0; begun < 3;) {
        const RunnerNews news = runner.next();
        if (news.kind == "split") process = static_cast<pid_t>(news.process);
        if (news.kind == "begun") begun = news.part + 1;
    }
    ::kill(process, SIGKILL);
    const RunnerNews news = runner.next();
    EXPECT_EQ(news.kind, "ended");
    ASSERT_TRUE(news.record.error);
    EXPECT_THAT(news.record.error->text(), testing::HasSubstr("the process that ran the script exited unexpectedly"));
    run(kA + kB + kC);
    EXPECT_EQ(printed("c"), "20\n");
}

/// Whether the process ends within five seconds, reaped or not.
bool ends(pid_t process) {
    for (int i = 0; i < 500; ++i) {
        std::ifstream file("/proc/" + std::to_string(process) + "/stat");
        const std::string text((std::istreambuf_iterator<char>(file)), {});
        if (text.empty() || text[text.rfind(')') + 2] == 'Z') return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

/// Behind a is a process that waits; with it go those behind it.
TEST_F(script_runner, begins_before_a_state_whose_process_was_killed) {
    std::vector<pid_t> kept;
    order(kA + kB + kC);
    while (runner.running()) {
        const RunnerNews news = runner.next();
        if (news.kind == "split") kept.push_back(static_cast<pid_t>(news.process));
    }
    ASSERT_GE(kept.size(), 2u);
    ::kill(kept[0], SIGKILL);
    ASSERT_TRUE(ends(kept[1])) << "until then its state would do";
    EXPECT_THAT(run(kA + kB + "-- %% id=c\nprint(x * 100)\n"), ElementsAre(0, 1, 2));
    EXPECT_EQ(printed("c"), "200\n");
}

TEST_F(script_runner, keeps_random_numbers_and_parallel_work_as_they_are) {
    const std::string study =
        " = montecarlo{system = 2/(tf(\"s\")^2 + 4*tf(\"s\") + 3), input = prbs(4, 20), Ts = 0.01, sigma = 0.2, runs = "
        "20,\n"
        "estimators = {lssvf = {{2, 1, 0}, 3}}}\n";
    const std::string start = "-- %% id=a\n" + kWork + "local m" + study + "work()\n";
    const std::string end = "-- %% id=b\nprint(randn(1))\nlocal n" + study + "print(n.lssvf.mean)\n";
    EXPECT_THAT(run(start + end), ElementsAre(0, 1));
    const std::string once = printed("b");
    EXPECT_THAT(run(start + end + "-- told of\n"), ElementsAre(1));
    EXPECT_EQ(printed("b"), once);
}

}  // namespace test_script_runner
