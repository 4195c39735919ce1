#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdio>
#include <string>

#include "bench/bench.h"
#include "numerics/validation/advice.h"
#include "support/advice_corpus.h"

namespace dynlab::bench {
namespace {

constexpr std::uint32_t kFirstAdviceSeed = 20'001;  // none that tests use
constexpr int kDataSets = 30;

using CriterionFunction = bool (*)(const Advice&, const test::CorpusKind&);

/// Adds the row: the number of data sets of a kind with wrong issues. Prints these data sets.
void count_wrong(const char* what, const test::CorpusKind& kind, CriterionFunction right, double bar, Report& report) {
    std::atomic<int> wrong = 0;
    tbb::parallel_for(0, kDataSets, [&](int i) {
        const std::uint32_t seed = kFirstAdviceSeed + static_cast<std::uint32_t>(i);
        const Advice advice = advise(kind.simulated_data(seed));
        if (right(advice, kind)) return;
        ++wrong;
        std::string reported;
        for (const DataIssue& issue : advice.findings)
            if (issue.weight == Weight::kWarning) reported += " " + issue.code;
        std::printf("%s, record %u: %s; told:%s\n", kind.name.c_str(), seed, what, reported.c_str());
    });
    report.results.push_back({"advice, " + kind.name + ": " + what, "all records", static_cast<double>(wrong),
                              static_cast<double>(kDataSets), bar, 0});
}

}  // namespace

/// The number of clean data sets with a warning, and the number of planted faults that are not found.
void measure_advice(Report& report) {
    for (const test::CorpusKind& kind : test::clean_kinds())
        count_wrong(
            "a warning", kind, [](const Advice& advice, const test::CorpusKind&) { return advice.clean(); }, 0, report);
    for (const test::CorpusKind& kind : test::faulty_kinds())
        count_wrong(
            "not found", kind,
            [](const Advice& advice, const test::CorpusKind& planted) {
                return std::any_of(planted.codes.begin(), planted.codes.end(),
                                   [&](const std::string& code) { return advice.has(code); });
            },
            0.1, report);
}

}  // namespace dynlab::bench
