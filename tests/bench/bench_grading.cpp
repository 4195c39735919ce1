#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <regex>

#include "bench/bench.h"
#include "bench/program_work.h"
#include "support/program.h"

namespace dynlab::bench {

namespace {

using test::Workbench;

constexpr int kSubmissions = 200, kWithFeedback = 20;
constexpr int kCores = 2;
constexpr double kMaxSeconds = 0.040, kGoalSeconds = 0.030, kMaxSecondsOfFeedback = 0.5;
constexpr double kMaxSecondsOfRegrade = 0.020, kMaxSecondsOfSimilarity = 2;

struct Seconds {
    double whole = 0, scripts = 0;
};

/// Of one run of `dynlab grade`, and of the scripts within.
Seconds grading_seconds(const Workbench& bench, int jobs, bool pdf) {
    std::vector<std::string> words = {"grade",     "in",     "--lesson",          "04", "--out", "out",
                                      "--regrade", "--jobs", std::to_string(jobs)};
    if (!pdf) words.push_back("--no-pdf");
    const auto start = std::chrono::steady_clock::now();
    const ChildResult graded = bench.dynlab(words);
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
    must_succeed(graded);
    const std::string logs = bench.shell("cat out/logs/*/log.txt").output;
    const std::regex line(R"(([0-9.]+) s of processor time)");
    Seconds seconds{whole.count(), 0};
    for (std::sregex_iterator i(logs.begin(), logs.end(), line), end; i != end; ++i)
        seconds.scripts += std::stod((*i)[1]);
    return seconds;
}

void add_submissions(const Workbench& bench, int from, int to) {
    for (int i = from; i <= to; ++i) bench.write("in/s" + std::to_string(i) + "/analysis.lua", kSubmissionOfLesson4);
}

double seconds_of(const Workbench& bench, const std::vector<std::string>& words) {
    const auto start = std::chrono::steady_clock::now();
    must_succeed(bench.dynlab(words));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Seconds to regrade the class in `folder` after a change to a custom check, when the scripts need no run.
double regrading_seconds(const Workbench& bench, const std::string& folder) {
    const auto grade = [&](const std::string& points, const char* again) {
        bench.write("own/own.lua", "check{id = 'gain', points = " + points +
                                       ", test = function(a) return near(dcgain(a.G_final), 2/3, {rel = 0.1}) end}\n");
        std::vector<std::string> words = {"grade",
                                          folder,
                                          "--lesson",
                                          "04",
                                          "--out",
                                          "re",
                                          "--no-pdf",
                                          "--checks",
                                          "own",
                                          "--jobs",
                                          std::to_string(kCores)};
        if (*again != '\0') words.emplace_back(again);
        return seconds_of(bench, words);
    };
    bench.shell("rm -rf re");
    grade("1", "");
    return grade("2", "--again");
}

}  // namespace

/// The time that a submission costs beyond the runs of its script, and a feedback PDF. One submission measures the
/// fixed cost of a class, such as the trial of the reference solution and the layout of documents. The fixed cost is
/// subtracted.
void measure_grading(Report& report) {
    const Workbench bench;
    add_submissions(bench, 1, 1);
    const double alone = grading_seconds(bench, kCores, false).whole;
    const double first = grading_seconds(bench, 1, true).whole - grading_seconds(bench, 1, false).whole;
    add_submissions(bench, 2, kWithFeedback);
    const double all = grading_seconds(bench, 1, true).whole - grading_seconds(bench, 1, false).whole;
    add_submissions(bench, kWithFeedback + 1, kSubmissions);
    const auto [whole, scripts] = grading_seconds(bench, kCores, false);
    rusage used{};
    ::getrusage(RUSAGE_CHILDREN, &used);
    report.results.push_back({"grading, overhead of a submission (s)", "40 ms",
                              (whole - alone - scripts / kCores) / (kSubmissions - 1), kMaxSeconds, 1,
                              kGoalSeconds / kMaxSeconds});
    bench.shell("mkdir one && cp -r in/s1 one");
    const double regraded = regrading_seconds(bench, "in") - regrading_seconds(bench, "one");
    report.results.push_back({"grading, a submission with changed checks (s)", "20 ms", regraded / (kSubmissions - 1),
                              kMaxSecondsOfRegrade, 1, 0});
    report.results.push_back({"grading, similarity of 200 scripts (s)", "2 s",
                              seconds_of(bench, {"similar", "in", "--lesson", "04", "--out", "alike"}),
                              kMaxSecondsOfSimilarity, 1, 0});
    report.results.push_back({"grading, a feedback PDF on one core (s)", "0.5 s", (all - first) / (kWithFeedback - 1),
                              kMaxSecondsOfFeedback, 1, 0});
    report.results.push_back({"grading, memory of the largest process (MB)", "200 MB",
                              static_cast<double>(used.ru_maxrss) / 1024, 200, 1, 0});
}

}  // namespace dynlab::bench
