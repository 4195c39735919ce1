#include "numerics/estimators/frequency/etfe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/signals/fourier.h"
#include "numerics/signals/random.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_etfe {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const Vector kB{{0.0, 0.5, 0.2}}, kF{{1.0, -0.9, 0.3}};

Complex truth_at(double angle) {
    const Complex q = std::polar(1.0, -angle);
    return (kB[0] + kB[1] * q + kB[2] * q * q) / (kF[0] + kF[1] * q + kF[2] * q * q);
}

/// Steady-state answer to repeated periods of a random input, the last period only.
IdData periodic(Index period, double noise, std::uint32_t seed) {
    RandomStream random(seed);
    const Vector one = random.normal(period);
    const Vector x = divided_by(kF, weighted_past(kB, one.replicate(12, 1)));
    return IdData(Matrix(x.tail(period) + noise * random.normal(period)), Matrix(one), 1);
}

TEST(etfe, is_exact_for_whole_periods_in_steady_state) {  // oracle: the true frequency response
    for (const Index period : {100, 101, 127}) {
        const SpectralEstimate estimate = etfe(periodic(period, 0, 3));
        ASSERT_GT(estimate.w.size(), period / 2 - 5);
        for (Index i = 0; i < estimate.w.size(); ++i)
            EXPECT_LT(std::abs(estimate.response[i] - truth_at(estimate.w[i])), 1e-8) << period << " " << estimate.w[i];
    }
}

TEST(etfe, raw_errors_are_those_of_the_noise) {  // oracle: var = noise spectrum over input power, 300 seeds
    double sum = 0;
    Index count = 0;
    for (std::uint32_t seed = 1; seed <= 300; ++seed) {
        const IdData data = periodic(64, 0.2, seed);
        const ComplexVector U = fourier_transform(data.experiments[0].u.col(0).array() - data.experiments[0].u.mean());
        const SpectralEstimate estimate = etfe(data);
        for (Index i = 0; i < estimate.w.size(); ++i) {
            const auto line = static_cast<Index>(std::lround(estimate.w[i] * 64 / (2 * std::numbers::pi)));
            const double expected = 64 * 0.04 / std::norm(U[line]);
            sum += std::norm(estimate.response[i] - truth_at(estimate.w[i])) / expected;
            ++count;
        }
    }
    EXPECT_NEAR(sum / static_cast<double>(count), 1, 0.05);
}

TEST(etfe, smoothing_brings_bands_that_hold_the_truth) {  // oracle: coverage over 200 seeds
    EtfeOptions options;
    options.smooth = 15;
    Index inside = 0, count = 0;
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
        const SpectralEstimate estimate = etfe(periodic(2000, 0.5, seed), options);
        for (Index i = 20; i < 980; i += 60) {
            inside += std::abs((estimate.response[i] - truth_at(estimate.w[i])).imag()) < 1.96 * estimate.std[i];
            ++count;
        }
    }
    EXPECT_NEAR(static_cast<double>(inside) / static_cast<double>(count), 0.95, 0.015);
}

TEST(etfe, smoothed_bands_widen_towards_the_ends_of_the_axis) {  // oracle: spread of the real part over 400 seeds
    EtfeOptions options;
    options.smooth = 25;
    const std::array<Index, 4> lines{1, 4, 296, 300};  // of 300; half the values beside 1 and 300 are conjugates
    Vector squares = Vector::Zero(4), stated = Vector::Zero(4);
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        const SpectralEstimate estimate = etfe(periodic(600, 0.5, seed), options);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const Index k = lines[i] - 1, row = static_cast<Index>(i);
            squares[row] += std::pow((estimate.response[k] - truth_at(estimate.w[k])).real(), 2);
            stated[row] += std::pow(estimate.std[k], 2);
        }
    }
    for (Index i = 0; i < 4; ++i) EXPECT_NEAR(squares[i] / stated[i], 1, 0.3) << i;  // four standard errors
}

TEST(etfe, frequencies_without_input_are_left_out) {  // oracle: the lines of a multisine
    Vector u = Vector::Zero(240);
    for (const int line : {5, 11, 40})
        for (Index k = 0; k < 240; ++k) u[k] += std::cos(2 * std::numbers::pi * line * static_cast<double>(k) / 240);
    const SpectralEstimate estimate = etfe(IdData(Matrix(3 * u), Matrix(u), 1));
    ASSERT_EQ(estimate.w.size(), 3);
    EXPECT_LT((estimate.response.array() - 3.0).abs().maxCoeff(), 1e-9);
    EXPECT_NEAR(estimate.w[1], 2 * std::numbers::pi * 11 / 240, 1e-12);
}

TEST(etfe, says_what_it_needs) {
    const IdData data = periodic(100, 0.1, 1);
    EtfeOptions wide;
    wide.smooth = 30;
    EXPECT_THAT(thrown_message([&] { etfe(data, wide); }), HasSubstr("the data have only 50"));
    EXPECT_THAT(thrown_message([&] { etfe(IdData::merge({data, data})); }), HasSubstr("or use spa"));
    wide.smooth = -1;
    EXPECT_THROW(etfe(data, wide), InvalidArgument);
}

TEST(etfe, transforms_of_any_length_follow_the_definition) {  // oracle: the sum, term by term
    for (const Index N : {1, 2, 8, 60, 97, 202, 211}) {
        const Vector x = RandomStream(7).normal(N);
        const ComplexVector X = fourier_transform(x);
        ASSERT_EQ(X.size(), N);
        for (Index k = 0; k < N; ++k) {
            Complex sum = 0;
            for (Index n = 0; n < N; ++n)
                sum += x[n] *
                       std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k * n % N) / static_cast<double>(N));
            EXPECT_LT(std::abs(X[k] - sum), 1e-12 * static_cast<double>(N)) << N << " " << k;
        }
    }
    EXPECT_EQ(fourier_transform(Vector()).size(), 0);
}

}  // namespace test_etfe
