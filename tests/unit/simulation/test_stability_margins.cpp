// Oracle: analytic, of loops whose crossovers have a formula.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/models/convert.h"
#include "numerics/simulation/stability_margins.h"

namespace test_stability_margins {

using namespace dynlab;

constexpr double kPi = std::numbers::pi;

TransferFunction loop(const Vector& num, const Vector& den, double delay = 0) {
    return TransferFunction(num, den, 0, delay);
}

TEST(stability_margins, of_loops_without_delay) {
    const auto third = stability_margins(loop(Vector{{4}}, Vector{{1, 3, 3, 1}}));  // 4/(s + 1)^3
    EXPECT_NEAR(third.gain_margin, 2, 1e-12);
    EXPECT_NEAR(third.gain_frequency, std::sqrt(3.0), 1e-12);
    const double w = std::sqrt(std::cbrt(16.0) - 1);
    EXPECT_NEAR(third.phase_frequency, w, 1e-12);
    EXPECT_NEAR(third.phase_margin, 180 - 3 * std::atan(w) * 180 / kPi, 1e-10);
    EXPECT_NEAR(third.delay_margin, (kPi - 3 * std::atan(w)) / w, 1e-12);

    const auto integrating = stability_margins(loop(Vector{{0.5}}, Vector{{1, 3, 2, 0}}));  // 0.5/(s (s + 1) (s + 2))
    EXPECT_NEAR(integrating.gain_margin, 12, 1e-11);
    EXPECT_NEAR(integrating.gain_frequency, std::sqrt(2.0), 1e-12);

    const auto first = stability_margins(loop(Vector{{10}}, Vector{{1, 1}}));
    EXPECT_EQ(first.gain_margin, kInfinity);
    EXPECT_TRUE(std::isnan(first.gain_frequency));
    EXPECT_NEAR(first.phase_margin, 180 - std::atan(std::sqrt(99.0)) * 180 / kPi, 1e-10);

    const auto small = stability_margins(loop(Vector{{0.5}}, Vector{{1, 1}}));
    EXPECT_EQ(small.phase_margin, kInfinity);
    EXPECT_EQ(small.delay_margin, kInfinity);
}

TEST(stability_margins, of_unstable_loops) {
    const auto beyond = stability_margins(loop(Vector{{16}}, Vector{{1, 3, 3, 1}}));
    EXPECT_NEAR(beyond.gain_margin, 0.5, 1e-12);
    EXPECT_LT(beyond.phase_margin, 0);
    const auto needed = stability_margins(loop(Vector{{2}}, Vector{{1, -1}}));  // L(0) = -2: the gain may halve
    EXPECT_NEAR(needed.gain_margin, 0.5, 1e-12);
    EXPECT_EQ(needed.gain_frequency, 0);
    EXPECT_NEAR(needed.phase_margin, 60, 1e-10);  // at sqrt(3)
}

TEST(stability_margins, counts_the_delay) {
    for (const double K : {0.3, 1.0, 20.0, 1e6})
        for (const double T : {0.01, 0.7, 30.0}) {
            const auto margins = stability_margins(loop(Vector{{K}}, Vector{{1, 0}}, T));
            EXPECT_NEAR(margins.phase_frequency / K, 1, 1e-12);
            EXPECT_NEAR(margins.phase_margin, std::remainder(90 - K * T * 180 / kPi, 360), 1e-6 * (1 + K * T));
            if (K * T > 3) continue;  // the first crossover is then the nearest to one
            EXPECT_NEAR(margins.gain_frequency * T, kPi / 2, 1e-11);
            EXPECT_NEAR(margins.gain_margin, kPi / (2 * K * T), 1e-11 * margins.gain_margin);
            EXPECT_NEAR(margins.delay_margin, kPi / 2 / K - T, 1e-9 / K);
        }
    const auto many = stability_margins(loop(Vector{{20}}, Vector{{1, 0}}, 30));  // crossings at 30 w = pi/2 + 2 pi m
    ASSERT_GE(many.gains.size(), 96u);
    for (std::size_t m = 0; m < 96; ++m)
        EXPECT_NEAR(many.gains[m].frequency * 30, kPi / 2 + 2 * kPi * static_cast<double>(m), 1e-9) << m;
    // exp(-s)/(s + 1) never leaves the unit circle; its first crossover: w + atan(w) = pi
    const auto inside = stability_margins(loop(Vector{{1}}, Vector{{1, 1}}, 1));
    const double w = inside.gain_frequency;
    EXPECT_NEAR(w + std::atan(w), kPi, 1e-12);
    EXPECT_NEAR(inside.gain_margin, std::sqrt(1 + w * w), 1e-12);
}

TEST(stability_margins, sees_a_narrow_resonance) {
    // 0.01/(s (s^2 + 0.001 s + 1)): at w = 1 the phase is -180 degrees and |L| = 10
    const auto margins = stability_margins(loop(Vector{{0.01}}, Vector{{1, 0.001, 1, 0}}));
    EXPECT_NEAR(margins.gain_margin, 0.1, 1e-10);
    EXPECT_NEAR(margins.gain_frequency, 1, 1e-12);
    EXPECT_EQ(margins.phases.size(), 3u);
}

TEST(stability_margins, of_discrete_loops) {
    const double Ts = 0.1, K = 0.5;  // K/(z - 1): |L| = K/(2 sin(w Ts/2)), phase -(90 + 90 w Ts/pi) degrees
    const auto margins = stability_margins(TransferFunction(Vector{{K}}, Vector{{1, -1}}, Ts));
    const double angle = 2 * std::asin(K / 2);
    EXPECT_NEAR(margins.phase_frequency, angle / Ts, 1e-10);
    EXPECT_NEAR(margins.phase_margin, 90 - angle / 2 * 180 / kPi, 1e-9);
    EXPECT_NEAR(margins.gain_margin, 2 / K, 1e-12);
    EXPECT_NEAR(margins.gain_frequency, kPi / Ts, 1e-12);
    // A delay counts as the equivalent poles at zero do.
    const TransferFunction late(Vector{{0.2}}, Vector{{1, -0.9}}, Ts, 5 * Ts);
    const auto by_delay = stability_margins(late), by_poles = stability_margins(with_rational_delay("test", late));
    EXPECT_NEAR(by_delay.gain_margin, by_poles.gain_margin, 1e-11);
    EXPECT_NEAR(by_delay.phase_margin, by_poles.phase_margin, 1e-9);
}

TEST(stability_margins, a_loop_without_gain_has_none) {
    const auto margins = stability_margins(TransferFunction(Vector{{0}}, Vector{{1, 1}}));
    EXPECT_EQ(margins.gain_margin, kInfinity);
    EXPECT_EQ(margins.phase_margin, kInfinity);
    EXPECT_TRUE(margins.gains.empty() && margins.phases.empty());
}

}  // namespace test_stability_margins
