// Measures what the project promises of speed and memory, each as a ratio against a peer or bound measured in the same
// run.
#include "bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "platform/memory.h"
#include "support/browser.h"

namespace dynlab::bench {
namespace {

double seconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

std::vector<double> repeated_seconds(int repetitions, const std::function<void()>& work) {
    std::vector<double> times;
    for (int k = 0; k < repetitions; ++k) times.push_back(seconds(work));
    return times;
}

double median_seconds(int repetitions, const std::function<void()>& work) {
    return median(repeated_seconds(repetitions, work));
}

std::pair<double, double> paired_medians(int repetitions, const std::function<void()>& a,
                                         const std::function<void()>& b) {
    std::vector<double> times_a, times_b;
    for (int k = 0; k < repetitions; ++k) {
        times_a.push_back(seconds(a));
        times_b.push_back(seconds(b));
    }
    return {median(times_a), median(times_b)};
}

}  // namespace dynlab::bench

namespace {

using namespace dynlab::bench;

/// True when every row is within its bar.
bool print_table(const Report& report) {
    fmt::print("{:<46} {:>11} {:>11} {:>8} {:>6} {:>6}\n", "what / against", "measured", "reference", "ratio", "bar",
               "goal");
    bool all_within = true;
    for (const Result& result : report.results) {
        const double ratio = result.measured / result.reference;
        const bool within = ratio <= result.bar;
        all_within = all_within && within;
        fmt::print("{:<46} {:>11.4g} {:>11.4g} {:>8.3g} {:>6.3g} {:>6} {}\n", result.what, result.measured,
                   result.reference, ratio, result.bar, result.goal > 0 ? fmt::format("{:.3g}", result.goal) : "",
                   within ? "" : "OVER THE BAR");
        fmt::print("    against {}\n", result.against);
    }
    if (!report.left_out.empty()) fmt::print("Left out; `scripts/bench --peers` installs what these rows need:\n");
    for (const std::string& row : report.left_out) fmt::print("    {}\n", row);
    return all_within;
}

}  // namespace

/// Measures the groups that are named, or all.
int main(int argc, char** argv) {
    dynlab::keep_freed_memory();  // as the program does
    // What starts programs comes first: later this process is large, and a copy of it (fork) takes 30 ms more and
    // counts in the memory of what it starts.
    const std::vector<std::pair<std::string, void (*)(Report&)>> groups{
        {"program", measure_program},     {"grading", measure_grading},
        {"course", measure_course},       {"cluster", measure_cluster},
        {"live", measure_live},           {"workbench", measure_workbench},
        {"site", measure_site},           {"web", measure_web},
        {"numerics", measure_numerics},   {"estimators", measure_estimators},
        {"irregular", measure_irregular}, {"lua", measure_lua},
        {"searches", measure_searches},   {"advice", measure_advice},
        {"grey_box", measure_grey_box}};
    const std::vector<std::string> named(argv + 1, argv + argc);
    for (const std::string& name : named) {
        if (std::any_of(groups.begin(), groups.end(), [&](const auto& group) { return group.first == name; })) continue;
        fmt::print(stderr, "There is no group of benchmarks named {}.\n", name);
        return 2;
    }
    Report report;
    std::vector<std::string> failures;
    for (const auto& [name, measure] : groups) {
        if (!named.empty() && std::find(named.begin(), named.end(), name) == named.end()) continue;
        try {
            measure(report);
        } catch (const std::exception& error) {  // the rows before it are printed
            failures.push_back(fmt::format("Group {}, after its last row above, failed: {}", name,
                                           *error.what() ? error.what() : "a program gave no reason"));
        }
    }
    dynlab::test::Browser::end_idle();
    const bool within = print_table(report);
    for (const std::string& failure : failures) fmt::print(stderr, "{}\n", failure);
    return within && failures.empty() ? 0 : 1;
}
