// A submission has a limit of processor time and, as a multiple of it, of clock time: a busy machine costs no marks.
// Oracles: stopped processes use no processor time; the rules for the messages.
#include <gmock/gmock.h>

#include <thread>

#include "base/reader.h"
#include "course/grading/grading_rules.h"
#include "course/grading_bench.h"
#include "course/sandbox_jobs/job_descriptions.h"
#include "course/sandbox_jobs/sandbox_work.h"

namespace dynlab::test {
namespace test_time_of_submissions {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kAnswers[] = "--   x: number\n";
constexpr char kChecks[] = "check{id = 'x', test = function(a) return a.x == 42 end}\n";
constexpr char kSolution[] = "local k = 0\nfor i = 1, 3e7 do k = k + i % 7 end\nanswer('x', 42)\n";

/// Grades, and stops each run of a script for longer than its processor time, as where others have the processors.
constexpr char kGradeWithPauses[] = R"sh(
descendants() { for c in $(cat /proc/$1/task/*/children 2>/dev/null); do echo $c; descendants $c; done; }
"$DYNLAB" grade in --lesson 99 --out out --isolation LEVEL --no-pdf --timeout 2 --jobs 1 & grade=$!
stopped=' '
while kill -0 $grade 2>/dev/null; do
  for c in $(descendants $grade); do
    case "$stopped" in *" $c "*) continue ;; esac
    if tr '\0' ' ' < /proc/$c/cmdline 2>/dev/null | grep -q '^[^ ]*dynlab[^ ]* boxed run'; then
      kill -STOP $c && sleep 3; kill -CONT $c; stopped="$stopped$c "
    fi
  done
  sleep 0.01
done
wait $grade; echo "code $?, stopped:$stopped"
)sh";

TEST(time_of_submissions, runs_that_wait_for_the_processor_pass) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", kSolution);
    std::string script = kGradeWithPauses;
    script.replace(script.find("LEVEL"), 5, GradingBench::level());
    const ChildResult graded = bench.bench().shell(script);
    EXPECT_THAT(graded.output, ContainsRegex("code 0, stopped: [0-9]")) << graded.error_output;
    EXPECT_EQ(GradingBench::score(bench.result("a")), 1);
}

TEST(time_of_submissions, a_machine_with_more_work_than_processors_fails_no_submission) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", kSolution);
    std::vector<ChildProcess> busy;
    for (unsigned i = 0; i < 2 * std::thread::hardware_concurrency(); ++i) {
        ChildOptions spin;
        spin.command = {"sh", "-c", "while :; do :; done"};
        busy.emplace_back(spin, "dash");
    }
    EXPECT_EQ(bench.grade({"--timeout", "3"}).exit_code, 0);
    EXPECT_EQ(GradingBench::score(bench.result("a")), 1);
}

TEST(time_of_submissions, the_limit_that_ended_one_is_reported_with_its_figure) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", "while true do end\n");
    bench.grade({"--timeout", "1"});
    EXPECT_THAT(GradingBench::error_reason(bench.result("a")),
                HasSubstr("the script used more than 1 s of processor time"));
}

// oracle: the same answer in a script that is stopped in Lua's own code
TEST(time_of_submissions, answers_before_a_long_call_of_lua_s_functions_count) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const std::string work = "local s = string.rep('a', 2e8) for i = 1, 100 do s:upper() end";
    bench.submit_file("loop", "answer('x', 42) while true do end\n");
    bench.submit_file("upper", "answer('x', 42) " + work + "\n");
    bench.submit_file("coroutine", "answer('x', 42) coroutine.wrap(function() " + work + " end)()\n");
    bench.submit_file("caught", "answer('x', 42) " + work + " pcall(function() " + work + " end)\n");
    ASSERT_EQ(bench.grade({"--timeout", "2"}).exit_code, 0);
    for (const char* name : {"loop", "upper", "coroutine", "caught"}) {
        EXPECT_EQ(GradingBench::score(bench.result(name)), 1) << name;
        EXPECT_THAT(GradingBench::error_reason(bench.result(name)),
                    HasSubstr("the script used more than 2 s of processor time"));
    }
}

// oracle: a sandbox without clock time ends before it uses any processor time
TEST(time_of_submissions, a_run_that_the_clock_ended_is_known_from_one_that_used_its_time) {
    const Workbench bench;
    bench.write("in/analysis.lua", "while true do end\n");
    const auto run = [&](const TimeLimits& limits) {
        Sandbox sandbox(strongest_isolation());
        RunJob job;
        job.script = sandbox.add(bench.path("in"), "/box/submission") / "analysis.lua";
        job.time_ms = 60000, job.memory_bytes = 1ull << 30;
        return run_in_sandbox(sandbox, DYNLAB_PROGRAM, job, limits);
    };
    EXPECT_TRUE(run({std::chrono::milliseconds(60000), 0}).waited);
    const auto used = run({std::chrono::milliseconds(100), 100});
    EXPECT_FALSE(used.output);
    EXPECT_FALSE(used.waited);
}

// oracle: the run of the reference solution, which is not repeated for the second submission
TEST(time_of_submissions, are_compared_with_the_worked_solution_also_where_it_is_cached) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    bench.submit_file("a", kSolution);
    ASSERT_EQ(bench.grade().exit_code, 0);
    bench.submit_file("b", kSolution);
    ASSERT_EQ(bench.grade().exit_code, 0);
    for (const char* name : {"a", "b"})
        EXPECT_THAT(bench.bench().read("out/logs/" + std::string(name) + "/log.txt"),
                    AllOf(ContainsRegex("run main: [0-9.]+ s of processor time \\(reference solution: [0-9.]+ s\\)"),
                          Not(HasSubstr("solution: 0.000 s"))));
}

TEST(time_of_submissions, a_worked_solution_that_uses_most_of_the_time_is_reported) {
    GradingSetup setup;
    setup.lesson = {"02_least_squares", lesson_folder("02_least_squares")};
    setup.isolation = strongest_isolation();
    setup.program = DYNLAB_PROGRAM;
    GradingRules rules(setup);
    EXPECT_EQ(rules.note_on_time(), std::nullopt);
    rules.compare_with_solution({{"main", 25}, {"seed", 29}});
    EXPECT_EQ(rules.note_on_time(), std::nullopt);
    rules.compare_with_solution({{"main", 25}, {"seed", 40}});
    EXPECT_THAT(message_text(rules.note_on_time().value_or(Message())),
                AllOf(HasSubstr("uses 40.0 s"), HasSubstr("may use 60 s (1.5 times")));
}

}  // namespace test_time_of_submissions
}  // namespace dynlab::test
