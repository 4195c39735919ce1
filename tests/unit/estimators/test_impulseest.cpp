#include "numerics/estimators/impulseest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "support/difference_equation.h"
#include "support/peak_memory.h"
#include "support/thrown_message.h"

namespace test_impulseest {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

/// 0 for `dead` samples, then a decaying oscillation.
Vector response_with(Index dead, Index count) {
    Vector g = Vector::Zero(count);
    for (Index i = dead; i < count; ++i) {
        const auto t = static_cast<double>(i - dead);
        g[i] = std::exp(-0.15 * t) * std::cos(0.3 * t);
    }
    return g;
}

IdData simulated_data(const Vector& g, const Vector& u, double noise, std::uint32_t seed) {
    return IdData(Matrix(weighted_past(g, u) + noise * RandomStream(seed).normal(u.size())), Matrix(u), 0.1);
}

ImpulseestOptions plain(Index lags) {
    ImpulseestOptions options;
    options.lags = lags;
    options.smooth = false;
    return options;
}

TEST(impulseest, is_exact_for_noise_free_finite_responses) {  // oracle: the response put in
    const Vector g = response_with(3, 21), u = RandomStream(2).normal(300);
    IdData data = simulated_data(g, u, 0, 1);
    data.experiments[0].y.array() += 7;  // an offset is estimated as well
    const ImpulseEstimate estimate = impulseest(data, plain(20));
    EXPECT_LT((estimate.response - g).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(estimate.noise_variance, 1e-24);
    EXPECT_EQ(estimate.t[20], 2);
}

TEST(impulseest, a_long_record_takes_little_more_than_itself) {  // oracle: the size of all its equations
    const IdData data = simulated_data(response_with(3, 21), RandomStream(2).normal(300000), 0.1, 1);
    const double before = peak_memory([] {}), equations = 300000.0 * 71 * sizeof(double) / (1 << 20);
    EXPECT_LT(peak_memory([&] { impulseest(data); }) - before, equations / 5);
}

TEST(impulseest, plain_errors_are_those_it_states) {  // oracle: statistics over 300 seeds
    const Vector g = response_with(2, 25), u = random_levels(500, 2, 9);
    Matrix errors(25, 300);
    Vector stated = Vector::Zero(25);
    for (Index run = 0; run < 300; ++run) {
        const ImpulseEstimate estimate =
            impulseest(simulated_data(g, u, 0.3, static_cast<std::uint32_t>(run + 1)), plain(24));
        errors.col(run) = estimate.response - g;
        stated += estimate.std / 300;
    }
    const Vector scatter = (errors.cwiseAbs2().rowwise().mean()).cwiseSqrt();
    EXPECT_NEAR((scatter.array() / stated.array()).mean(), 1, 0.03);
    EXPECT_LT((errors.rowwise().mean().array() / (scatter.array() / std::sqrt(300.0))).abs().maxCoeff(), 4);
}

TEST(impulseest, smoothing_lowers_the_error) {  // oracle: the response put in, 30 seeds
    const Vector g = response_with(4, 61), u = random_levels(600, 3, 4);
    double rough = 0, smooth = 0;
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        const IdData data = simulated_data(g, u, 0.5, seed);
        ImpulseestOptions options;
        options.lags = 60;
        smooth += (impulseest(data, options).response - g).squaredNorm();
        rough += (impulseest(data, plain(60)).response - g).squaredNorm();
    }
    EXPECT_LT(smooth, 0.25 * rough);
}

TEST(impulseest, smooth_errors_hold_for_responses_of_the_prior) {  // oracle: g drawn from the prior, 100 seeds
    const double lambda = 0.85;
    Index inside = 0;
    for (std::uint32_t seed = 1; seed <= 100; ++seed) {
        RandomStream random(seed);
        Vector g = Vector::Zero(41);
        for (Index j = 40; j >= 0; --j) {  // increments of variance lambda^j - lambda^(j+1) from the far end
            const double power = std::pow(lambda, static_cast<double>(j));
            g.head(j + 1).array() += std::sqrt(j < 40 ? power * (1 - lambda) : power) * random.normal();
        }
        ImpulseestOptions options;
        options.lags = 40;
        const ImpulseEstimate estimate =
            impulseest(simulated_data(g, random_levels(500, 2, seed), 1, seed + 300), options);
        inside += ((estimate.response - g).array().abs() < 1.96 * estimate.std.array()).count();
    }
    EXPECT_NEAR(static_cast<double>(inside) / 4100, 0.95, 0.03);
}

TEST(impulseest, the_smooth_estimate_follows_the_data_when_noise_vanishes) {  // oracle: the response put in
    const Vector g = response_with(0, 31), u = RandomStream(3).normal(400);
    ImpulseestOptions options;
    options.lags = 30;
    EXPECT_LT((impulseest(simulated_data(g, u, 1e-6, 1), options).response - g).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(impulseest, regularized_is_the_dense_posterior) {  // oracle: N x N conditioning, N = 100, means taken off
    const IdData data = simulated_data(response_with(1, 25), random_levels(100, 1, 3), 0.2, 4);
    for (const ResponseKernel kernel : {ResponseKernel::kTc, ResponseKernel::kDc, ResponseKernel::kSs}) {
        ImpulseestOptions options;
        options.lags = 24;
        options.kernel = kernel;
        const RegressedResponse found = impulseest(data, options);
        const Vector u = data.experiments[0].u.col(0), y = data.experiments[0].y.col(0).tail(76);
        Matrix Phi(76, 25);
        for (Index i = 0; i < 25; ++i) Phi.col(i) = u.segment(24 - i, 76).array() - u.segment(24 - i, 76).mean();
        const Matrix K = found.prior_scale * prior_kernel(*found.prior, 25);
        const Matrix S = Phi * K * Phi.transpose() + found.noise_variance * Matrix::Identity(76, 76);
        const Matrix gain = K * Phi.transpose() * S.inverse();
        const Vector mean = gain * Vector(y.array() - y.mean());
        EXPECT_LT((found.response - mean).cwiseAbs().maxCoeff(), 1e-8 * mean.cwiseAbs().maxCoeff());
        EXPECT_LT((found.covariance - (K - gain * Phi * K)).cwiseAbs().maxCoeff(), 1e-8 * K.maxCoeff());
        EXPECT_LT((found.covariance.diagonal().cwiseSqrt() - found.std).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(impulseest, smoother_kernels_suit_smoother_responses) {  // oracle: the response put in, 30 seeds
    Vector g(80);
    for (Index i = 0; i < 80; ++i) {
        const auto t = static_cast<double>(i);
        g[i] = 0.01 * t * t * std::exp(-0.15 * t);
    }
    double tc = 0, ss = 0;
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        const IdData data = simulated_data(g, random_levels(500, 3, seed), 0.5, seed + 50);
        ImpulseestOptions options;
        options.lags = 79;
        tc += (impulseest(data, options).response - g).squaredNorm();
        options.kernel = ResponseKernel::kSs;
        ss += (impulseest(data, options).response - g).squaredNorm();
    }
    EXPECT_LT(ss, 0.9 * tc);
}

TEST(impulseest, reads_the_dead_time) {    // oracle: the dead time put in, 100 seeds each
    for (const Index dead : {1, 5, 12}) {  // a held input acts one sample late: g_1 is the first without dead time
        Index right = 0;
        for (std::uint32_t seed = 1; seed <= 100; ++seed) {
            const ImpulseEstimate estimate =
                impulseest(simulated_data(response_with(dead, 60), random_levels(700, 3, seed), 0.2, seed + 500));
            right += estimate.first && std::abs(*estimate.first - dead) <= 1;
        }
        EXPECT_GE(right, 90) << dead;
    }
}

TEST(impulseest, an_input_without_effect_is_reported) {  // oracle: independent noise; false alarms over 200 seeds
    Index alarms = 0;
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
        const Vector u = random_levels(500, 1, seed);
        const ImpulseEstimate estimate =
            impulseest(IdData(Matrix(RandomStream(seed + 999).normal(500)), Matrix(u), 1), plain(30));
        alarms += estimate.first.has_value();
    }
    EXPECT_LE(alarms, 4);
}

TEST(impulseest, joins_experiments_with_offsets_of_their_own) {  // oracle: the response put in
    const Vector g = response_with(1, 15);
    IdData a = simulated_data(g, RandomStream(1).normal(100), 0, 1),
           b = simulated_data(g, RandomStream(2).normal(80), 0, 1);
    a.experiments[0].y.array() += 5;
    b.experiments[0].y.array() -= 3;
    EXPECT_LT((impulseest(IdData::merge({a, b}), plain(14)).response - g).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(impulseest, poor_inputs_need_the_smooth_estimate) {  // oracle: a sine gives two regressors
    Vector u(400);
    for (Index k = 0; k < 400; ++k) u[k] = std::sin(0.2 * static_cast<double>(k));
    const IdData data = simulated_data(response_with(1, 60), u, 0.01, 1);
    EXPECT_THAT(thrown_message([&] { impulseest(data, plain(60)); }),
                HasSubstr("not persistently exciting of order 61, the number of samples of the impulse response"));
    ImpulseestOptions options;
    options.lags = 60;
    EXPECT_TRUE(impulseest(data, options).response.allFinite());
}

TEST(impulseest, says_what_it_needs) {
    const IdData data = simulated_data(response_with(1, 20), RandomStream(1).normal(60), 0.1, 1);
    EXPECT_THAT(thrown_message([&] { impulseest(data, plain(30)); }), HasSubstr("30 lags need at least 90 samples"));
    EXPECT_THROW(impulseest(data, plain(-1)), InvalidArgument);
    EXPECT_THAT(thrown_message([&] { impulseest(data, plain(500)); }), HasSubstr("between 1 and 400"));
    ImpulseestOptions sure;
    sure.confidence = 1;
    EXPECT_THROW(impulseest(data, sure), InvalidArgument);
    EXPECT_THAT(thrown_message([&] { impulseest(data.select({1}, {})); }), HasSubstr("no input"));
}

TEST(impulseest, a_response_that_outlasts_the_lags_is_reported) {
    const Vector g = Vector::Constant(200, 0.1);
    const ImpulseEstimate estimate = impulseest(simulated_data(g, RandomStream(1).normal(900), 0.01, 1), plain(40));
    ASSERT_EQ(estimate.warnings.size(), 1u);
    EXPECT_THAT(message_text(estimate.warnings[0]), HasSubstr("not decayed"));
}

}  // namespace test_impulseest
