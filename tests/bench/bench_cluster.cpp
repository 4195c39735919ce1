#include "bench/bench.h"
#include "bench/program_work.h"
#include "cluster/loopback.h"
#include "support/program.h"

namespace dynlab::bench {

namespace {

using test::LoopbackSlurm;
using test::Workbench;

constexpr int kClass = 300, kRepetitions = 3, kProcesses = 2;
constexpr double kMaxTimeAgainstThreads = 1.25, kMaxTimeAgainstOneCore = 1 / 1.8;

// The experiment of lesson 4: its system, its data with noise of 0.2, its two estimators.
constexpr const char* kDataSets =
    "print(montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 100000, seed = "
    "3,\n    estimators = {lssvf = {{2, 1, 0}, 3}, ivsvf = {{2, 1, 0}, 3}}})\n";

void run_by_shell(const Workbench& bench, const std::string& command) {
    must_succeed(bench.shell(command));
}

std::string grading_on(const std::string& more) {
    return "rm -rf out; \"$DYNLAB\" grade in --lesson 04 --out out --no-pdf " + more;
}

}  // namespace

/// What it costs to split work, on one machine, where nothing can be gained by it: a class in parts by two processes
/// against the same class on two threads; and what is gained by a second process for a study.
void measure_cluster(Report& report) {
    const Workbench bench;
    for (int i = 1; i <= kClass; ++i) bench.write("in/s" + std::to_string(i) + "/analysis.lua", kSubmissionOfLesson4);
    const std::string threads = grading_on("--jobs " + std::to_string(kProcesses));
    const auto [alone, processes] = paired_medians(
        kRepetitions, [&] { run_by_shell(bench, threads); },
        [&] { run_by_shell(bench, grading_on("--on processes:" + std::to_string(kProcesses))); });
    report.results.push_back(
        {"300 submissions by two processes", "two threads", processes, alone, kMaxTimeAgainstThreads, 0});
    const LoopbackSlurm slurm;
    if (slurm.reason_to_skip().empty()) {
        const std::string in_slurm = "export " + slurm.environment() + "; " + grading_on("--on slurm:tasks=2") +
                                     "; timeout 300 bash -c 'until [ -e out/summary.md ]; do sleep 0.1; done'";
        const auto [local, shared] = paired_medians(
            kRepetitions, [&] { run_by_shell(bench, threads); }, [&] { run_by_shell(bench, in_slurm); });
        report.results.push_back(
            {"300 submissions on two nodes of Slurm", "two threads", shared, local, kMaxTimeAgainstThreads, 0});
    } else {
        report.left_out.push_back("300 submissions on two nodes of Slurm: " + slurm.reason_to_skip());
    }
    bench.write("records.lua", kDataSets);
    const auto [one, two] = paired_medians(
        1, [&] { run_by_shell(bench, "DYNLAB_NO_CACHE=1 taskset -c 0 \"$DYNLAB\" run records.lua --out one"); },
        [&] { run_by_shell(bench, "rm -rf two; \"$DYNLAB\" study records.lua --on processes:2 --out two"); });
    report.results.push_back({"100,000 records on two processes", "one core", two, one, kMaxTimeAgainstOneCore, 0});
}

}  // namespace dynlab::bench
