#include <gtest/gtest.h>

#include <cmath>

#include "numerics/models/sampled_system.h"

namespace test_sampled_system {

using namespace dynlab;

SampledSystem lag(double Ts, Hold hold, double delay) {  // 1/(s + 1) and a feed-through of 0.5
    return discretize(Matrix{{-1}}, Vector{{1.0}}, Matrix{{1}}, Vector{{0.5}}, Ts, hold, delay);
}

TEST(sampled_system, held_input_with_a_delay_between_samples) {  // oracle: analytic, Astrom and Wittenmark (1997) 2.3
    const double Ts = 0.5, rest = 0.2;
    const SampledSystem system = lag(Ts, Hold::kZoh, 2 * Ts + rest);
    EXPECT_EQ(system.delay, 2);
    EXPECT_NEAR(system.F(0, 0), std::exp(-Ts), 2e-16);
    EXPECT_EQ(system.G(0, 0), 0);
    EXPECT_NEAR(system.G(0, 1), 1 - std::exp(-(Ts - rest)), 2e-16);
    EXPECT_NEAR(system.G(0, 2), std::exp(-(Ts - rest)) - std::exp(-Ts), 2e-16);
    EXPECT_EQ(system.D(0, 0), 0);  // at a sampling instant the feed-through still sees the previous sample
    EXPECT_EQ(system.D(0, 1), 0.5);
}

TEST(sampled_system, straight_input_follows_a_ramp) {  // oracle: analytic, x' = -x + t - delay has x = t - delay - 1
    const double Ts = 0.5, delay = 0.7;
    const SampledSystem system = lag(Ts, Hold::kFoh, delay);
    const auto input = [&](Index k) { return Ts * static_cast<double>(k - system.delay); };
    const auto state = [&](Index k) { return Ts * static_cast<double>(k) - delay - 1; };
    for (Index k = 3; k < 6; ++k) {
        const Vector samples{{input(k + 1), input(k), input(k - 1)}};
        EXPECT_NEAR(system.F(0, 0) * state(k) + system.G.row(0).dot(samples), state(k + 1), 1e-15);
        const double output = state(k) + system.D.row(0).dot(samples.tail(2));
        EXPECT_NEAR(output, state(k) + 0.5 * (Ts * static_cast<double>(k) - delay), 1e-15);
    }
}

TEST(sampled_system, weights_add_up_to_the_held_step) {  // oracle: property, constant inputs look alike in every hold
    for (const Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const double delay : {0.0, 0.1, 0.5, 1.23}) {
            const SampledSystem system = lag(0.5, hold, delay);
            EXPECT_NEAR(system.G.sum(), 1 - std::exp(-0.5), 1e-15);
            EXPECT_NEAR(system.D.sum(), 0.5, 1e-15);
        }
}

TEST(sampled_system, derivatives_add_up_to_the_signal) {  // oracle: definition, sum den_i s^(n-i)/den = 1
    const Vector den{{1, 6, 11, 6}};
    const SampledSystem system = derivative_filter(den, 0.1, Hold::kFoh);
    EXPECT_LT((den.transpose() * system.C).norm(), 1e-14);
    EXPECT_NEAR(den.dot(system.D.col(0)), 1, 1e-15);
}

}  // namespace test_sampled_system
