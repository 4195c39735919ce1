// Measures what the project promises of speed and memory, each as a ratio against a peer or bound measured in the same
// run.
#include "bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace dynlab::bench {
namespace {

double seconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

}  // namespace

double median_seconds(int repetitions, const std::function<void()>& work) {
    std::vector<double> times;
    for (int k = 0; k < repetitions; ++k) times.push_back(seconds(work));
    return median(times);
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

int main() {
    using namespace dynlab::bench;
    std::vector<Result> results;
    measure_numerics(results);
    measure_program(results);
    fmt::print("{:<46} {:>11} {:>11} {:>8} {:>6} {:>6}\n", "what / against", "measured", "reference", "ratio", "bar",
               "goal");
    bool all_within = true;
    for (const Result& result : results) {
        const double ratio = result.measured / result.reference;
        const bool within = ratio <= result.bar;
        all_within = all_within && within;
        fmt::print("{:<46} {:>11.4g} {:>11.4g} {:>8.3f} {:>6.3g} {:>6} {}\n", result.what, result.measured,
                   result.reference, ratio, result.bar, result.goal > 0 ? fmt::format("{:.3g}", result.goal) : "",
                   within ? "" : "OVER THE BAR");
        fmt::print("    against {}\n", result.against);
    }
    return all_within ? 0 : 1;
}
