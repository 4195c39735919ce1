// Oracles: the Cramer-Rao bound from derivatives by hand; the best linear approximation of a cube under a normal input,
// 1 + 3 eps s^2, and the variance of what it leaves, 6 eps^2 s^6 (Pintelon and Schoukens 2012, chapter 3).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "numerics/estimators/frequency/bla.h"
#include "numerics/estimators/frequency/frequency_fit.h"
#include "numerics/signals/random_phase_multisine.h"
#include "numerics/simulation/lsim.h"

namespace test_frequency_statistics {

using namespace dynlab;

TEST(frequency_statistics, maximum_likelihood_reaches_the_cramer_rao_bound) {
    constexpr int kRuns = 1000;  // a spread from 1000 runs has a relative error of 2.2 %
    const Vector theta{{0.8, 4.0, 2.0}};
    const Vector w = Vector::LinSpaced(40, std::log(0.3), std::log(12)).array().exp();
    Vector variance = 0.002 * w.cwiseInverse();
    Matrix information = Matrix::Zero(3, 3);
    ComplexVector truth(w.size());
    for (Index k = 0; k < w.size(); ++k) {
        const Complex s(0, w[k]), F = s * s + theta[0] * s + theta[1];
        truth[k] = theta[2] / F;
        const ComplexVector slope{{-theta[2] * s / (F * F), -theta[2] / (F * F), 1.0 / F}};
        information += 2 / variance[k] * (slope.conjugate() * slope.transpose()).real();
    }
    const Matrix bound = information.inverse();
    Matrix found(kRuns, 3);
    Vector reported = Vector::Zero(3);
    for (int run = 0; run < kRuns; ++run) {
        RandomStream random(static_cast<std::uint32_t>(run + 1));
        ComplexVector H = truth;
        for (Index k = 0; k < w.size(); ++k) {
            const double size = std::sqrt(variance[k] / 2), re = random.normal(), im = random.normal();
            H[k] += size * Complex(re, im);
        }
        const Fit fit = frequency_fit("coe", frequency_data(H, w, variance), TransferStructure::single(2, 0));
        found.row(run) = fit.theta.transpose();
        reported += fit.std / kRuns;
    }
    const Eigen::RowVectorXd mean = found.colwise().mean();
    for (Index i = 0; i < 3; ++i) {
        const double spread = std::sqrt((found.col(i).array() - mean[i]).square().sum() / (kRuns - 1));
        EXPECT_NEAR(spread / std::sqrt(bound(i, i)), 1, 0.1) << "parameter " << i;
        EXPECT_NEAR(reported[i] / std::sqrt(bound(i, i)), 1, 0.1) << "parameter " << i;
        EXPECT_LT(std::abs(mean[i] - theta[i]), 3.5 * spread / std::sqrt(kRuns)) << "parameter " << i;
    }
}

// The square of what is left, u^3 - 3 s^2 u, has 9.6 times its mean as standard deviation, and a realization of F lines
// holds 2 F independent values: 0.5 dB (12 %) are four standard errors of the means over the realizations below.
TEST(frequency_statistics, a_cube_has_its_gain_and_its_distortion) {
    constexpr Index kPeriod = 1024, kRealizations = 100;
    const double eps = 0.1, s = 0.7;
    RandomPhaseOptions options;
    options.amplitude = s;
    RandomStream random(3);
    Vector u(2 * kPeriod * kRealizations);
    for (Index m = 0; m < kRealizations; ++m)
        u.segment(2 * kPeriod * m, 2 * kPeriod) = random_phase_multisine(kPeriod, options, random).u.replicate(2, 1);
    const Vector noise = 0.01 * random.normal(u.size());
    const Vector y = u.array() + eps * u.array().cube() + noise.array();
    BlaOptions asked;
    asked.period = kPeriod, asked.realizations = kRealizations;
    const FrequencyData found = bla(IdData(Matrix(y), Matrix(u), 1), asked);

    const double gain = found.response.real().mean(), expected = 1 + 3 * eps * s * s;
    const double error = std::sqrt(found.variance.mean() / 2 / static_cast<double>(found.w.size()));
    // 511 lines: the kurtosis of their sum lies 3/(2 511) below that of a normal signal, and the gain follows it
    EXPECT_NEAR(gain, expected, 4 * error + 1.5 / 511 * 3 * eps * s * s);
    const double total = 6 * eps * eps * std::pow(s, 6);
    const LevelSums sums = level_sums(found);
    EXPECT_LT(std::abs(10 * std::log10(sums.distortion / total)), 0.5);
    EXPECT_LT(std::abs(10 * std::log10(sums.noise / (1e-4 / 2))), 0.5);
    EXPECT_LT(std::abs(10 * std::log10(sums.power / (expected * expected * s * s + total))), 0.5);
}

TEST(frequency_statistics, distortion_of_odd_lines_is_found_at_lines_without_input) {
    constexpr Index kPeriod = 1024, kRealizations = 330;
    const double eps = 0.1, s = 0.7;
    RandomPhaseOptions options;
    options.amplitude = s, options.odd = true, options.detection = 4;
    options.lines = Vector::LinSpaced(300, 1, 300);
    RandomStream random(4);
    Vector u(2 * kPeriod * kRealizations);
    for (Index m = 0; m < kRealizations; ++m)
        u.segment(2 * kPeriod * m, 2 * kPeriod) = random_phase_multisine(kPeriod, options, random).u.replicate(2, 1);
    const Vector y = u.array() + eps * u.array().cube();
    BlaOptions asked;
    asked.period = kPeriod, asked.realizations = kRealizations;
    const FrequencyData found = bla(IdData(Matrix(y), Matrix(u), 1), asked);
    EXPECT_LT(std::abs(10 * std::log10(level_sums(found).distortion / (6 * eps * eps * std::pow(s, 6)))), 0.5);
    EXPECT_LT(found.even.power.sum(), 1e-20);
}

// The errors of distortion are uncorrelated between lines but not independent: taken as independent, they would be 1.5
// times too small for the gain (oracle: the scatter over the data sets, known to 4 %).
TEST(frequency_statistics, errors_with_distortion_are_those_of_the_scatter) {
    constexpr int kRuns = 250, kRealizations = 10;
    constexpr double kTs = 0.05, kCube = 0.1, kNoise = 0.01;
    const TransferFunction plant(Vector{{2.0}}, Vector{{1.0, 1.2, 4.0}});
    RandomPhaseOptions lines;
    lines.lines = Vector::LinSpaced(80, 1, 80), lines.odd = true, lines.detection = 4;
    BlaOptions asked;
    asked.period = 500, asked.transient = 2;
    Matrix found(kRuns, 3);
    Vector reported = Vector::Zero(3);
    for (int run = 0; run < kRuns; ++run) {
        RandomStream random(static_cast<std::uint32_t>(run + 1));
        std::vector<IdData> parts;
        for (int m = 0; m < kRealizations; ++m) {
            const Vector u = random_phase_multisine(500, lines, random).u.replicate(5, 1), x = lsim(plant, u, kTs);
            const Vector y = x.array() + kCube * x.array().cube() + kNoise * random.normal(u.size()).array();
            parts.emplace_back(Matrix(y), Matrix(u), kTs);
        }
        const Fit fit = frequency_fit("coe", bla(IdData::merge(parts), asked), TransferStructure::single(2, 0));
        found.row(run) = fit.theta.transpose();
        reported += fit.covariance.diagonal() / kRuns;
    }
    const Eigen::RowVectorXd mean = found.colwise().mean();
    for (Index i = 0; i < 3; ++i) {
        const double spread = std::sqrt((found.col(i).array() - mean[i]).square().sum() / (kRuns - 1));
        EXPECT_LT(spread / std::sqrt(reported[i]), 1.15) << "parameter " << i;
        EXPECT_GT(spread / std::sqrt(reported[i]), 0.85) << "parameter " << i;
    }
}

}  // namespace test_frequency_statistics
