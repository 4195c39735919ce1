#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <ctime>

#include "bench/bench.h"
#include "numerics/estimators/srivc.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::bench {
namespace {

constexpr double kSamplingTime = 0.05, kDelay = 0.37, kNoise = 0.02;
constexpr Index kSteady = 20;  // samples of a level of the held input
constexpr double kBar = 5;     // times the time for regular data

/// 2/(s^2 + 4s + 3) e^(-0.37 s) with noise, at these instants.
IdData data_at(const Vector& t, const Vector& u, bool regular) {
    const TransferFunction G = TransferFunction(Vector::Constant(1, 2.0), Vector{{1, 4, 3}}).with_delay(kDelay);
    const Vector noise = kNoise * RandomStream(2).normal(u.size());
    if (regular) return IdData(Matrix(lsim(G, u, kSamplingTime) + noise), Matrix(u), kSamplingTime);
    return IdData(Matrix(lsim(G, u, t) + noise), Matrix(u), t);
}

/// Steps between a half and one and a half of the regular ones.
Vector uneven_instants(Index samples) {
    const Vector chance = RandomStream(3).uniform(samples);
    Vector t(samples);
    t[0] = 0;
    for (Index k = 1; k < samples; ++k) t[k] = t[k - 1] + kSamplingTime * (0.5 + chance[k]);
    return t;
}

double processor_seconds(const std::function<void()>& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Two poles, the delay looked for.
void estimate(const IdData& data) {
    TransferStructure structure = TransferStructure::single(2, 0);
    structure.free_delays = true;
    FitOptions alone;
    tbb::task_arena arena(1);
    arena.execute([&] {
        if (!(srivc(data, structure, alone).fit_percent[0] > 0)) throw std::logic_error("nothing was estimated");
    });
}

/// In turn and on one core; the least of the processor's times, for others can only add to them.
void measure_pair(const std::string& input, const Vector& u, Report& report) {
    const Index N = u.size();
    const IdData regular = data_at({}, u, true), irregular = data_at(uneven_instants(N), u, false);
    const int repetitions = std::clamp(static_cast<int>(100'000 / N), 7, 41);
    double of_regular = kInfinity, of_irregular = kInfinity;
    for (int i = 0; i < repetitions; ++i) {
        of_irregular = std::min(of_irregular, processor_seconds([&] { estimate(irregular); }));
        of_regular = std::min(of_regular, processor_seconds([&] { estimate(regular); }));
    }
    report.results.push_back({fmt::format("SRIVC, irregular, {}, N = {} (s)", input, N), "regular sampling (s)",
                              of_irregular, of_regular, kBar, 0});
}

}  // namespace

/// What irregular sampling costs of processor time: two poles, the delay looked for.
void measure_irregular(Report& report) {
    for (const Index N : {1000, 4000, 16'000}) {
        measure_pair("held input", prbs(10, kSteady).replicate(1 + N / (1023 * kSteady), 1).topRows(N), report);
        measure_pair("moving input", RandomStream(1).normal(N), report);
    }
}

}  // namespace dynlab::bench
