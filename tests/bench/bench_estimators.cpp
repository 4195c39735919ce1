#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "bench/bench.h"
#include "bench/peers.h"
#include "numerics/estimators/frequency/bla.h"
#include "numerics/estimators/impulseest.h"
#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/lssvf.h"
#include "numerics/estimators/recursive/rivsvf.h"
#include "numerics/estimators/recursive/rlssvf.h"
#include "numerics/estimators/recursive/rsrivc.h"
#include "numerics/estimators/srivc.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/signals/random_phase_multisine.h"
#include "numerics/simulation/lsim.h"
#include "support/peak_memory.h"

namespace dynlab::bench {
namespace {

constexpr double kSamplingTime = 0.01, kCutoff = 3, kNoise = 0.2;
constexpr Index kShort = 1500, kLong = 1'000'000, kVeryLong = 10'000'000;
constexpr int kRuns = 200;

/// Data of 2/(s^2 + 4s + 3): its response x to a binary sequence that does not repeat, and y = x + noise.
struct DataSet {
    explicit DataSet(Index samples)
        : u(samples == kShort ? prbs(4, 100).head(samples) : prbs(17, 100).head(samples)),
          x(lsim(TransferFunction(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3)), u, kSamplingTime)),
          y(x + kNoise * RandomStream(1).normal(samples)),
          data(y, u, kSamplingTime) {}

    Vector u, x, y;
    IdData data;
};

Vector lssvf_theta(const IdData& data) {
    SvfOptions options;
    options.lambda = kCutoff;
    return lssvf(data, TransferStructure::single(2, 0), options).theta;
}

Vector ivsvf_theta(const IdData& data) {
    SvfOptions options;
    options.lambda = kCutoff;
    return ivsvf(data, TransferStructure::single(2, 0), options).theta;
}

Vector srivc_theta(const IdData& data) {
    FitOptions options;
    options.lambda = kCutoff;
    return srivc(data, TransferStructure::single(2, 0), options).theta;
}

using Method = Vector (*)(const IdData&);

/// In an arena of one thread, whatever the machine has.
Vector on_one_core(const std::function<Vector()>& work) {
    tbb::task_arena arena(1);
    Vector result;
    arena.execute([&] { result = work(); });
    return result;
}

/// Both samples of every instant once, in the order of time, as an estimator cannot do without.
double read_once(const Vector& u, const Vector& y) {
    return u.dot(y);
}

void measure_lssvf(const DataSet& million, const DataSet& ten_million, Report& report) {
    const auto estimate = [](const DataSet& data_set) {
        return on_one_core([&] { return lssvf_theta(data_set.data); });
    };
    {
        const PeerData file(million.u, million.y);
        const auto work = [&] { return estimate(million); };
        compare_with_peer({"LSSVF, N = 1e6 (s)", Peer::kNumpy, "lssvf", 1.0 / 100, 1.0 / 150, 21}, file, work, report);
        compare_with_peer({"LSSVF, N = 1e6 (s)", Peer::kNumpy, "lssvf_lstsq", 1.0 / 100, 1.0 / 150, 21}, file, work,
                          report);
        compare_with_peer({"LSSVF, N = 1e6 (s)", Peer::kOctave, "lssvf", 1.0 / 100, 0, 21}, file, work, report);
    }
    double check = 0;
    const auto [measured, reference] = paired_medians(
        11, [&] { check += estimate(ten_million).sum(); }, [&] { check += read_once(ten_million.u, ten_million.y); });
    if (check == 0) throw std::logic_error("nothing was estimated");
    report.results.push_back({"LSSVF, N = 1e7 (s)", "one read of u and y (s)", measured, reference, 3, 2});
    const PeerData file(ten_million.u, ten_million.y);
    compare_with_peer(
        {"LSSVF, N = 1e7 (s)", Peer::kNumpy, "lssvf", 1.0 / 100, 1.0 / 150, 5, 3}, file,
        [&] { return estimate(ten_million); }, report);
}

void measure_srivc(const DataSet& data_set, const std::string& what, double goal, int repetitions, Report& report) {
    const PeerData file(data_set.u, data_set.y);
    const auto work = [&] { return on_one_core([&] { return srivc_theta(data_set.data); }); };
    const int peer_repetitions = std::min(repetitions, 101);
    compare_with_peer({what, Peer::kNumpy, "srivc", 1.0 / 25, goal, repetitions, peer_repetitions}, file, work, report);
    compare_with_peer({what, Peer::kOctave, "srivc", 1.0 / 25, 0, repetitions, std::min(peer_repetitions, 21)}, file,
                      work, report);
}

/// What it costs that no cut-off frequency is known: several are tried.
void measure_starts(const DataSet& data_set, Report& report) {
    const TransferStructure structure = TransferStructure::single(2, 0);
    FitOptions alone;
    double check = 0;
    const auto [measured, reference] = paired_medians(
        301, [&] { check += srivc(data_set.data, structure, alone).loss; },
        [&] { check += srivc_theta(data_set.data)[0]; });
    if (check == 0) throw std::logic_error("nothing was estimated");
    report.results.push_back(
        {"SRIVC, N = 1500, all starts (s)", "cut-off frequency given (s)", measured, reference, 3, 0});
}

/// Means of LSSVF, IVSVF and SRIVC over the runs.
Vector monte_carlo(const DataSet& data_set, int threads) {
    Matrix theta(9, kRuns);
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(0, kRuns, [&](int run) {
            const auto seed = static_cast<std::uint32_t>(1 + run);
            const IdData data(data_set.x + kNoise * RandomStream(seed).normal(data_set.x.size()), data_set.u,
                              kSamplingTime);
            theta.col(run) << lssvf_theta(data), ivsvf_theta(data), srivc_theta(data);
        });
    });
    return theta.rowwise().mean();
}

void measure_monte_carlo(const DataSet& data_set, Report& report) {
    const std::string what = "Monte Carlo, 200 runs, N = 1500 (s)";
    // Other random numbers: the means of 200 runs differ by half a percent at most.
    constexpr double kTolerance = 0.05;
    compare_with_peer(
        {what, Peer::kNumpy, "monte_carlo", 1.0 / 30, 1.0 / 60, 11, 5, kTolerance}, {data_set.u, data_set.x},
        [&] { return monte_carlo(data_set, 1); }, report);
    const auto [two, one] = paired_medians(
        21, [&] { monte_carlo(data_set, 2); }, [&] { monte_carlo(data_set, 1); });
    report.results.push_back({what + ", two threads", "one thread (s)", two, one, 1 / 1.7, 0});
}

/// Uses ten different data sets. A single one would stay in the processor cache, whose speed would look like growth.
void measure_growth(const std::string& what, Method method, const DataSet& ten_million, Report& report) {
    const auto estimate = [&](const IdData& data) { on_one_core([&] { return method(data); }); };
    std::vector<IdData> pieces;
    for (Index first = 0; first < kVeryLong; first += kLong)
        pieces.push_back(ten_million.data.range(first + 1, first + kLong));
    const auto [measured, reference] = paired_medians(
        11, [&] { estimate(ten_million.data); },
        [&] {
            for (const IdData& piece : pieces) estimate(piece);
        });
    report.results.push_back({what + ", N = 1e7 (s)", "ten records of N = 1e6 (s)", measured, reference, 1.2, 0});
}

/// Five realizations of four periods, noise and distortion included.
void measure_response(Report& report) {
    constexpr Index kPeriod = 50'000, kPeriods = 4, kRealizations = 5;
    RandomStream random(1);
    Vector u(kLong);
    for (Index m = 0; m < kRealizations; ++m)
        u.segment(m * kPeriods * kPeriod, kPeriods * kPeriod) =
            random_phase_multisine(kPeriod, {}, random).u.replicate(kPeriods, 1);
    const Vector x = lsim(TransferFunction(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3)), u, kSamplingTime);
    const IdData data(Matrix(x + kNoise * random.normal(kLong)), Matrix(u), kSamplingTime);
    BlaOptions options;
    options.period = kPeriod, options.realizations = kRealizations;
    double check = 0;
    const double measured = median_seconds(11, [&] { check += bla(data, options).variance.sum(); });
    if (!(check > 0)) throw std::logic_error("nothing was estimated");
    report.results.push_back({"frequency response by bla, N = 1e6 (s)", "0.2 s", measured, 0.2, 1, 0});
}

/// 200 coefficients from 10^5 samples, hyperparameters included.
void measure_impulse_responses(Report& report) {
    constexpr Index kSamples = 100'000, kCoefficients = 200;
    constexpr double kSecondsOfAResponse = 0.3;
    RandomStream random(1);
    const Vector u = random.normal(kSamples);
    const Vector x = lsim(TransferFunction(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 1.2, 4)), u, kSamplingTime);
    const IdData data(Matrix(x + kNoise * random.normal(kSamples)), Matrix(u), kSamplingTime);
    const std::pair<const char*, ResponseKernel> kKernels[] = {
        {"TC", ResponseKernel::kTc}, {"DC", ResponseKernel::kDc}, {"SS", ResponseKernel::kSs}};
    for (const auto& [name, kernel] : kKernels) {
        ImpulseestOptions options;
        options.lags = kCoefficients, options.kernel = kernel;
        double check = 0;
        const double measured = median_seconds(5, [&] { check += impulseest(data, options).response.sum(); });
        if (check == 0) throw std::logic_error("nothing was estimated");
        report.results.push_back({std::string("regularized response, kernel ") + name + ", N = 1e5, 200 lags (s)",
                                  "0.3 s", measured, kSecondsOfAResponse, 1, 0});
    }
}

void measure_memory(const std::string& what, Method method, Report& report) {
    const IdData data = std::move(DataSet(kVeryLong).data);
    const double megabytes = 2.0 * static_cast<double>(kVeryLong) * sizeof(double) / (1 << 20);
    const double peak = test::peak_memory([&] { method(data); });
    report.results.push_back(
        {"peak memory of " + what + ", N = 1e7 (MB)", "the data and 64 MB", peak, megabytes + 64, 1, 0});
}

/// One pass with forgetting, against what a sample may cost.
template <class Method>
void measure_recursive(const std::string& what, Method method, const DataSet& data_set, Report& report) {
    constexpr double kSecondsPerSample = 200e-9;
    RecursiveOptions options;
    options.lambda = kCutoff;
    options.forgetting = 0.999;
    double check = 0;
    const double seconds =
        median_seconds(5, [&] { check += method(data_set.data, TransferStructure::single(2, 0), options).theta[0]; });
    if (check == 0) throw std::logic_error("nothing was estimated");
    report.results.push_back({what + ", N = 1e6 (s)", "200 ns a sample (s)", seconds,
                              kSecondsPerSample * static_cast<double>(data_set.u.size()), 1, 0});
}

}  // namespace

void measure_estimators(Report& report) {
    {
        const DataSet data_set(kShort);
        measure_srivc(data_set, "SRIVC, N = 1500 (s)", 1.0 / 40, 301, report);
        measure_starts(data_set, report);
        measure_monte_carlo(data_set, report);
    }
    measure_response(report);
    measure_impulse_responses(report);
    measure_memory("LSSVF", lssvf_theta, report);
    measure_memory("SRIVC", srivc_theta, report);
    const DataSet million(kLong), ten_million(kVeryLong);
    measure_lssvf(million, ten_million, report);
    measure_srivc(million, "SRIVC, N = 1e6 (s)", 1.0 / 80, 11, report);
    measure_recursive("recursive LSSVF", rlssvf, million, report);
    measure_recursive("recursive IVSVF", rivsvf, million, report);
    measure_recursive("recursive SRIVC", rsrivc, million, report);
    measure_growth("LSSVF", lssvf_theta, ten_million, report);
    measure_growth("SRIVC", srivc_theta, ten_million, report);
}

}  // namespace dynlab::bench
