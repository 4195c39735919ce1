#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdio>

#include "bench/bench.h"
#include "numerics/error.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/estimators/rivc.h"
#include "numerics/estimators/srivc.h"
#include "support/search_corpus.h"

namespace dynlab::bench {
namespace {

constexpr std::uint32_t kFirstSeed = 10'001;  // none that tests use
constexpr int kSystems = 300, kIrregularSystems = 100;
constexpr Index kMaxIrregularSamples = 5000;
constexpr double kSolved = 1.01;  // loss against that of the true system

struct Count {
    std::atomic<int> tried = 0, failed = 0, unstable = 0;
};

TransferStructure structure_of(const test::SearchCase& one) {
    TransferStructure structure = TransferStructure::single(one.poles, one.zeros);
    structure.free_delays = one.delayed;
    return structure;
}

std::string process_name(const test::SearchCase& one) {
    return "P" + std::to_string(one.poles) + (one.delayed ? "D" : "") + (one.zeros > 0 ? "Z" : "");
}

bool is_unstable(const Fit& fit) {
    return (fit.models.front().poles().real().array() > 0).any();
}

using Method = std::function<Fit(const test::SearchCase&)>;

/// Default settings, structure known. Systems that were not solved are printed.
void count_unsolved(const char* method, int systems, Index max_samples, bool irregular, const Method& fit,
                    Count& count) {
    tbb::parallel_for(0, systems, [&](int i) {
        const std::uint32_t seed = kFirstSeed + static_cast<std::uint32_t>(i);
        const test::SearchCase one = test::search_case(seed, max_samples, irregular);
        if (std::string(method) == "procsrivc" && !one.process) return;
        ++count.tried;
        double ratio = kInfinity;
        std::string failure;
        try {
            const Fit found = fit(one);
            ratio = found.loss / one.loss_at_truth;
            if (is_unstable(found)) ++count.unstable;
        } catch (const InvalidArgument& error) {
            failure = error.what();
        }
        if (ratio <= kSolved) return;
        ++count.failed;
        std::printf("%s: system %u (%d poles, %d zeros%s, %td samples): loss %.4g of the true system's %s\n", method,
                    seed, one.poles, one.zeros, one.delayed ? ", a delay" : "", one.data.sample_count(), ratio,
                    failure.c_str());
    });
}

}  // namespace

/// How many random systems are not found from default settings.
void measure_searches(Report& report) {
    const auto transfer = [](const test::SearchCase& one) { return srivc(one.data, structure_of(one), FitOptions{}); };
    const auto with_noise = [](const test::SearchCase& one) {
        return rivc(one.data, structure_of(one), NoiseOrders{.nd = 1}, FitOptions{});  // as tfrivc has it
    };
    const auto process = [](const test::SearchCase& one) {
        return procsrivc(one.data, ProcessStructure::parse(process_name(one)), ProcsrivcOptions{});
    };
    const auto add = [&](const std::string& what, const char* against, int failed, int tried, double bar) {
        report.results.push_back({what, against, static_cast<double>(failed), static_cast<double>(tried), bar, 0});
    };
    Count regular, noisy, processes, irregular;
    count_unsolved("tfsrivc", kSystems, 20'000, false, transfer, regular);
    add("tfsrivc: systems not solved", "all", regular.failed, regular.tried, 1.0 / 204);
    add("tfsrivc: unstable models", "all", regular.unstable, regular.tried, 0.02);
    count_unsolved("tfrivc", kSystems, 20'000, false, with_noise, noisy);
    add("tfrivc: systems not solved", "all", noisy.failed, noisy.tried, 1.0 / 204);
    count_unsolved("procsrivc", kSystems, 20'000, false, process, processes);
    add("procsrivc: systems not solved", "all", processes.failed, processes.tried, 1.0 / 97);
    count_unsolved("irregular", kIrregularSystems, kMaxIrregularSamples, true, transfer, irregular);
    add("tfsrivc, irregular sampling: systems not solved", "all", irregular.failed, irregular.tried, 0.02);
}

}  // namespace dynlab::bench
