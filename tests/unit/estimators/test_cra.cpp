#include "numerics/estimators/cra.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_cra {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const Vector kResponse{{0.0, 0.0, 1.0, 0.7, 0.4, 0.2, 0.1, 0.0, 0.0, 0.0, 0.0}};

IdData simulated_data(const Vector& u, double noise, std::uint32_t seed) {
    return IdData(Matrix(weighted_past(kResponse, u) + noise * RandomStream(seed).normal(u.size())), Matrix(u), 0.2);
}

CraOptions with(Index lags, Index whitening) {
    CraOptions options;
    options.lags = lags;
    options.whitening = whitening;
    return options;
}

/// An autoregressive input of which the whitening filter is known.
Vector colored(Index N, std::uint32_t seed) {
    return divided_by(Vector{{1.0, -1.2, 0.5}}, RandomStream(seed).normal(N));
}

TEST(cra, is_the_correlation_divided_by_the_power) {  // oracle: direct sums
    const IdData data = simulated_data(RandomStream(1).normal(150), 0.3, 2);
    const CorrelationAnalysis result = cra(data, with(10, 0));
    const Vector u = data.experiments[0].u.col(0).array() - data.experiments[0].u.mean();
    const Vector y = data.experiments[0].y.col(0).array() - data.experiments[0].y.mean();
    for (Index lag = 0; lag <= 10; ++lag) {
        double sum = 0;
        for (Index k = lag; k < 150; ++k) sum += y[k] * u[k - lag];
        EXPECT_NEAR(result.impulse.response[lag], sum / u.squaredNorm(), 1e-13);
    }
}

TEST(cra, finds_the_whitening_filter) {  // oracle: the autoregression put in
    const CorrelationAnalysis result = cra(simulated_data(colored(50000, 3), 0, 1), with(10, 2));
    EXPECT_NEAR(result.whitening_filter[1], -1.2, 0.02);
    EXPECT_NEAR(result.whitening_filter[2], 0.5, 0.02);
    EXPECT_LT(result.input_correlation.tail(10).cwiseAbs().maxCoeff(), 4 / std::sqrt(50000.0));
}

TEST(cra, whitening_makes_it_the_impulse_response) {  // oracle: the response put in, within four standard errors
    const CorrelationAnalysis result = cra(simulated_data(colored(20000, 5), 0.3, 1), with(10, 10));
    const Vector error = (result.impulse.response - kResponse).cwiseAbs();
    EXPECT_LT((error.array() / result.impulse.std.array()).maxCoeff(), 4);
    const CorrelationAnalysis without = cra(simulated_data(colored(20000, 5), 0.3, 1), with(10, 0));
    EXPECT_GT((without.impulse.response - kResponse).cwiseAbs().maxCoeff(), 0.3);
    EXPECT_FALSE(without.impulse.warnings.empty());
}

TEST(cra, chance_stays_inside_its_band) {  // oracle: independent signals, share over 100 seeds
    Index outside = 0;
    for (std::uint32_t seed = 1; seed <= 100; ++seed) {
        const IdData data(Matrix(RandomStream(seed + 500).normal(1000)), Matrix(colored(1000, seed)), 1);
        const ImpulseEstimate estimate = cra(data, with(30, 5)).impulse;
        outside += (estimate.response.array().abs() > 2.576 * estimate.null_std.array()).count();
    }
    EXPECT_NEAR(static_cast<double>(outside) / 3100, 0.01, 0.006);
}

TEST(cra, reads_the_dead_time) {  // oracle: response_2 is the first, so one sample of dead time
    const ImpulseEstimate estimate = cra(simulated_data(random_levels(2000, 1, 2), 0.3, 8), with(10, 5)).impulse;
    ASSERT_TRUE(estimate.first);
    EXPECT_EQ(*estimate.first, 2);
    EXPECT_THAT(message_text(estimate.message), HasSubstr("the dead time is about 0.2 s (1 sample)"));
}

TEST(cra, experiments_are_joined) {  // oracle: sums over both
    const IdData a = simulated_data(RandomStream(1).normal(400), 0.1, 1),
                 b = simulated_data(RandomStream(2).normal(300), 0.1, 2);
    const Vector joint = cra(IdData::merge({a, b}), with(8, 0)).impulse.response;
    const auto power = [](const IdData& d) {
        return (d.experiments[0].u.array() - d.experiments[0].u.mean()).matrix().squaredNorm();
    };
    const Vector sum = cra(a, with(8, 0)).impulse.response * power(a) + cra(b, with(8, 0)).impulse.response * power(b);
    EXPECT_LT((joint - sum / (power(a) + power(b))).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(cra, a_regular_input_is_reported_and_a_sine_does_no_harm) {
    Vector u(300);
    for (Index k = 0; k < 300; ++k) u[k] = std::sin(0.2 * static_cast<double>(k));
    const ImpulseEstimate estimate = cra(simulated_data(u, 0.01, 1)).impulse;
    EXPECT_TRUE(estimate.response.allFinite());
}

TEST(cra, says_what_it_needs) {
    const IdData data = simulated_data(RandomStream(1).normal(60), 0.1, 1);
    EXPECT_THAT(thrown_message([&] { cra(data, with(30, 10)); }), HasSubstr("30 lags need at least 90 samples"));
    EXPECT_THROW(cra(data, with(5, -1)), InvalidArgument);
    EXPECT_THROW(cra(data, with(5, 101)), InvalidArgument);
    EXPECT_THAT(thrown_message([&] { cra(data.range(1, 12)); }), HasSubstr("at least 18 samples"));
}

}  // namespace test_cra
