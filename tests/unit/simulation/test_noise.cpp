#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/simulation/noise.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_noise {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

TEST(noise, gain_of_simple_filters) {  // oracle: analytic
    EXPECT_NEAR((ColoredNoise{Vector{{1, 0.5}}, Vector{{1}}}.gain()), std::sqrt(1.25), 1e-14);
    for (const double a : {0.0, 0.9, -0.99})
        EXPECT_NEAR((ColoredNoise{Vector{{1}}, Vector{{1, -a}}}.gain()), 1 / std::sqrt(1 - a * a), 1e-7) << a;
    // (1 + c q^-1)/(1 - a q^-1): (1 + c^2 + 2 a c)/(1 - a^2)
    EXPECT_NEAR((ColoredNoise{Vector{{1, 0.4}}, Vector{{1, -0.7}}}.gain()), std::sqrt((1.16 + 0.56) / 0.51), 1e-12);
}

TEST(noise, white_noise_is_the_stream_itself) {  // oracle: definition
    RandomStream one(7), other(7);
    EXPECT_EQ(ColoredNoise{}.draw(50, 0.3, one), 0.3 * other.normal(50));
}

/// Correlations of lags 0.. of a long signal.
Vector correlations(const Vector& v, Index lags) {
    Vector r(lags);
    for (Index lag = 0; lag < lags; ++lag)
        r[lag] = v.head(v.size() - lag).dot(v.tail(v.size() - lag)) / static_cast<double>(v.size());
    return r;
}

TEST(noise, has_the_spectrum_of_its_filter) {  // oracle: the correlations that |C/D|^2 has, by a sum over frequencies
    const ColoredNoise noise{Vector{{1, 0.9}}, Vector{{1, -1, 0.2}}};
    RandomStream random(3);
    const Index N = 400000;
    const Vector v = noise.draw(N, 0.5, random), r = correlations(v, 6);
    const int steps = 4096;
    for (Index lag = 0; lag < 6; ++lag) {
        double expected = 0;
        for (int i = 0; i < steps; ++i) {
            const double w = 2 * std::numbers::pi * i / steps;
            const Complex z = std::polar(1.0, -w);
            const Complex H = (1.0 + 0.9 * z) / (1.0 - z + 0.2 * z * z);
            expected += 0.25 * std::norm(H) * std::cos(w * static_cast<double>(lag)) / steps;
        }
        EXPECT_NEAR(r[lag] / r[0], expected / r[0], 0.02) << lag;
    }
    EXPECT_NEAR(std::sqrt(r[0]), 0.5 * noise.gain(), 0.01 * std::sqrt(r[0]));
}

TEST(noise, is_stationary_from_its_first_sample_on) {  // oracle: statistics with fixed seeds
    const ColoredNoise slow{Vector{{1}}, Vector{{1, -0.98}}};
    RandomStream random(11);
    double squares = 0;
    for (int run = 0; run < 4000; ++run) squares += std::pow(slow.draw(1, 1, random)[0], 2) / 4000;
    EXPECT_NEAR(squares * (1 - 0.98 * 0.98), 1, 0.08);
}

TEST(noise, that_wanders_off_begins_at_rest) {  // oracle: the running sum
    RandomStream one(7), other(7);
    const ColoredNoise sum{Vector{{1}}, Vector{{1, -1}}};
    EXPECT_LT((sum.draw(50, 1, one) - divided_by(Vector{{1, -1}}, other.normal(50))).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_THAT(thrown_message([&] { (void)sum.gain(); }), HasSubstr("on or outside the unit circle"));
}

TEST(noise, of_a_given_snr) {  // oracle: definition
    const Vector x{{1, -1, 3, 1}};
    EXPECT_NEAR(noise_std_of_snr(x, 20), std::sqrt(2.0) / 10, 1e-14);
    EXPECT_NEAR(noise_std_of_snr(x, 0), std::sqrt(2.0), 1e-14);
    EXPECT_THAT(thrown_message([&] { noise_std_of_snr(Vector::Ones(4), 10); }), HasSubstr("that changes"));
    EXPECT_THAT(thrown_message([&] { noise_std_of_snr(x, kInfinity); }), HasSubstr("finite number in dB"));
    RandomStream random;
    EXPECT_THAT(thrown_message([&] { ColoredNoise{}.draw(3, -1, random); }), HasSubstr("nonnegative"));
}

}  // namespace test_noise
