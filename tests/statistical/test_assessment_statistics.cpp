// Oracle: the scatter of estimates over fixed seeds.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/assessment.h"
#include "numerics/plants/crane_experiments.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/colored_noise.h"

namespace test_assessment_statistics {

using namespace dynlab;
using namespace dynlab::test;

constexpr int kRuns = 200;
constexpr double kTs = 0.05;
// The standard deviation from 200 runs has a relative error of 1/sqrt(398) = 5 %: this is three of them.
constexpr double kAllowed = 0.15;

/// Two outputs with one denominator, the second in units a hundred times smaller.
struct TwoOutputs {
    double first_noise, second_noise;  // standard deviations
    double in_common;                  // correlation of the two
    TransferStructure structure = TransferStructure::grid(2, 1, Denominators::kCommon, {2}, {0, 1}, {0, 0});
    Vector theta = values({1.2, 4, 4, 100, 300});

    IdData simulated_data(std::uint32_t seed) const {
        const Vector u = prbs(7, 8);
        const Vector first = noise(u.size(), seed), own = noise(u.size(), seed + 10000);
        const Vector second = in_common * first + std::sqrt(1 - in_common * in_common) * own;
        const auto models = structure.models(theta);
        Matrix y(u.size(), 2);
        y << lsim(models[0], u, kTs) + first_noise * first, lsim(models[1], u, kTs) + second_noise * second;
        return IdData(y, Matrix(u), kTs);
    }

    /// Colored, of variance one.
    static Vector noise(Index N, std::uint32_t seed) {
        return 0.8 * arma_signal(values({1}), values({1, -0.6}), N, seed);
    }
};

struct Runs {
    Vector spread, robust;  // standard deviation over the runs, mean of the robust standard errors
};

Runs runs_of(const TwoOutputs& system) {
    Matrix values(kRuns, system.theta.size());
    Runs runs{{}, Vector::Zero(system.theta.size())};
    for (int run = 0; run < kRuns; ++run) {
        const IdData data = system.simulated_data(static_cast<std::uint32_t>(run + 1));
        const Fit estimate = srivc(data, system.structure, FitOptions{}.from_rest());
        values.row(run) = estimate.theta.transpose();
        runs.robust += assess(data, estimate).std / kRuns;
    }
    runs.spread =
        ((values.rowwise() - values.colwise().mean()).colwise().squaredNorm() / (kRuns - 1)).cwiseSqrt().transpose();
    return runs;
}

void expect_honest_errors(const TwoOutputs& system) {
    const Runs runs = runs_of(system);
    for (Index i = 0; i < system.theta.size(); ++i)
        EXPECT_NEAR(runs.robust[i] / runs.spread[i], 1, kAllowed)
            << system.structure.parameter_names()[static_cast<std::size_t>(i)] << ": " << runs.robust[i] << ", "
            << runs.spread[i];
}

/// The crane's estimation data. The voltage is integrated (exactly, with foh); the outputs are relative to the initial
/// rest.
IdData crane_data(std::uint32_t seed) {
    constexpr Index kRest = 50;
    const CraneExperiments experiments;
    const CraneData simulated_data = simulate_crane({}, experiments, seed).front();
    const Index N = simulated_data.u.size();
    Vector integral = Vector::Zero(N);
    for (Index k = 1; k < N; ++k) integral[k] = integral[k - 1] + experiments.Ts * simulated_data.u[k - 1];
    Matrix y(N, 2);
    y << simulated_data.x, simulated_data.theta;
    y.rowwise() -= y.topRows(kRest).colwise().mean().eval();
    IdData data(y, Matrix(integral), experiments.Ts);
    data.hold = Hold::kFoh;
    return data;
}

TEST(assessment_statistics, robust_errors_of_outputs_with_one_denominator_are_their_scatter) {
    expect_honest_errors({.first_noise = 0.05, .second_noise = 50, .in_common = 0});
}

TEST(assessment_statistics, robust_errors_are_the_scatter_where_outputs_have_a_disturbance_in_common) {
    expect_honest_errors({.first_noise = 0.1, .second_noise = 10, .in_common = 0.9});
}

using Noise = Vector (*)(Index, std::uint32_t);
using Method = Fit (*)(const IdData&, const TransferStructure&);

/// The share of 95 % intervals that contain the true value: 200 data sets of 1500 samples, 10 dB.
double coverage_of(Method method, Noise noise, bool robust, double Ts = kTs) {
    const TransferStructure structure = TransferStructure::single(2, 0);
    const Vector theta = values({1.2, 4, 4}), u = prbs(8, static_cast<int>(std::lround(0.3 / Ts))).head(1500);
    const Vector x = lsim(structure.models(theta)[0], u, Ts);
    const double size = std::sqrt((x.array() - x.mean()).square().mean() / 10);
    Matrix estimates(kRuns, 3), errors(kRuns, 3);
    for (int run = 0; run < kRuns; ++run) {
        const Vector y = x + size * noise(u.size(), static_cast<std::uint32_t>(run + 1));
        const IdData data{Matrix(y), Matrix(u), Ts};
        const Fit fit = method(data, structure);
        estimates.row(run) = fit.theta.transpose();
        errors.row(run) = (robust ? assess(data, fit).std : fit.std).transpose();
    }
    const Matrix off = (estimates.rowwise() - theta.transpose()).cwiseAbs();
    return static_cast<double>((off.array() < 1.96 * errors.array()).count()) / (3 * kRuns);
}

/// x(k) = a x(k-1) + w(k), of variance one and settled.
Vector slow_noise(Index N, std::uint32_t seed) {
    constexpr double kPole = 0.99;
    Vector v = RandomStream(seed).normal(N + 2000);
    for (Index k = 1; k < v.size(); ++k) v[k] += kPole * v[k - 1];
    return std::sqrt(1 - kPole * kPole) * v.tail(N);
}
Vector white_noise(Index N, std::uint32_t seed) {
    return RandomStream(seed).normal(N);
}
Vector mixed_noise(Index N, std::uint32_t seed) {
    return std::sqrt(0.5) * (slow_noise(N, seed) + white_noise(N, seed + 5000));
}
Vector resonant_noise(Index N, std::uint32_t seed) {
    Vector v = RandomStream(seed).normal(N + 2000);
    for (Index k = 2; k < v.size(); ++k) v[k] += 1.99 * std::cos(0.05) * v[k - 1] - 0.995 * 0.995 * v[k - 2];
    return v.tail(N) / std::sqrt(v.tail(N).squaredNorm() / static_cast<double>(N));
}

Fit srivc_of(const IdData& data, const TransferStructure& structure) {
    return srivc(data, structure, FitOptions{}.from_rest());
}
Fit ivsvf_of(const IdData& data, const TransferStructure& structure) {
    SvfOptions options;
    options.lambda = 3;
    Fit fit = ivsvf(data, structure, options);
    color_covariance(fit, data, options, true);
    return fit;
}

// 600 intervals, those of one run depending on each other: a standard deviation of 1.2 % or less about 95 %.
TEST(assessment_statistics, robust_intervals_hold_what_they_say_whatever_the_noise) {
    for (const Noise noise : {white_noise, slow_noise, mixed_noise, resonant_noise})
        EXPECT_NEAR(coverage_of(srivc_of, noise, true), 0.95, 0.03);
}

// Thirty seconds hold few periods of the slow noise, some of which the parameters take for dynamics.
TEST(assessment_statistics, robust_intervals_see_slow_noise_behind_white_in_a_short_record) {
    EXPECT_NEAR(coverage_of(srivc_of, mixed_noise, true, 0.02), 0.95, 0.05);
}

// The filters color the equation error, whatever the noise.
TEST(assessment_statistics, intervals_of_the_instrumental_variable_method_hold_what_they_say) {
    for (const Noise noise : {white_noise, slow_noise, mixed_noise, resonant_noise})
        EXPECT_NEAR(coverage_of(ivsvf_of, noise, false), 0.95, 0.03);
}

// Oracle: position and angle of the crane together hold more information about their common poles than either alone.
TEST(assessment_statistics, two_outputs_of_the_crane_are_no_less_certain_than_one) {
    constexpr int kSeeds = 8;
    const auto single = TransferStructure::single(3, 2);
    const auto common = TransferStructure::grid(2, 1, Denominators::kCommon, {3}, {2, 2}, {0, 0});
    Vector alone = Vector::Zero(3), together = Vector::Zero(3);
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        const IdData data = crane_data(seed), position = data.select({1}, {1});
        alone += assess(position, srivc(position, single, FitOptions{}.from_rest())).std.head(3) / kSeeds;
        together += assess(data, srivc(data, common, FitOptions{}.from_rest())).std.head(3) / kSeeds;
    }
    for (Index i = 0; i < 3; ++i) EXPECT_LT(together[i], (1 + kAllowed) * alone[i]) << "a" << i + 1;
}

}  // namespace test_assessment_statistics
