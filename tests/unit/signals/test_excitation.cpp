#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/signals/excitation.h"

namespace test_excitation {

using namespace dynlab;

TEST(excitation, step_signal_by_hand) {  // oracle: analytic
    EXPECT_EQ(step_signal(5, 3, -1, 2), (Vector{{-1, -1, 2, 2, 2}}));
    EXPECT_EQ(step_signal(3), Vector::Ones(3));
    EXPECT_EQ(step_signal(2, 3), Vector::Zero(2));
    EXPECT_THROW(step_signal(0), InvalidArgument);
    EXPECT_THROW(step_signal(3, 5), InvalidArgument);
    EXPECT_THROW(step_signal(3, 0), InvalidArgument);
}

TEST(excitation, sine_at_quarter_periods) {  // oracle: analytic
    const Vector u = sine(0.25, 8, 1, 3);
    ASSERT_EQ(u.size(), 8);
    const Vector expected{{0, 3, 0, -3, 0, 3, 0, -3}};
    EXPECT_LT((u - expected).lpNorm<Eigen::Infinity>(), 1e-14);
    EXPECT_NEAR(sine(0.25, 1, 1, 1, std::numbers::pi / 2)(0), 1, 1e-15);
}

TEST(excitation, chirp_sweeps_its_frequency) {  // oracle: analytic, zeros of sin(2 pi (f0 t + (f1 - f0) t^2/(2 T)))
    const double f0 = 1, f1 = 5, T = 10, Ts = 0.001;
    const Vector u = chirp(f0, f1, T, Ts);
    ASSERT_EQ(u.size(), 10000);
    const double sweep = (f1 - f0) / T;
    Index crossings = 0;
    for (Index k = 1; k < u.size(); ++k) {
        if (u(k - 1) * u(k) >= 0) continue;
        ++crossings;
        const double half_turns = static_cast<double>(crossings);
        const double expected = (std::sqrt(f0 * f0 + sweep * half_turns) - f0) / sweep;
        EXPECT_NEAR(expected, (static_cast<double>(k) - 0.5) * Ts, Ts) << "crossing " << crossings;
    }
    EXPECT_GE(crossings, 58);  // (f0 + f1)/2 T = 30 turns: 60 half turns, the first zero at t = 0, the last at t = T
    EXPECT_LE(crossings, 59);
}

TEST(excitation, square_chirp_is_the_sign_of_the_chirp) {  // oracle: definition
    const Vector smooth = chirp(1, 5, 10, 0.01), square = chirp(1, 5, 10, 0.01, ChirpShape::kSquare);
    for (Index k = 0; k < smooth.size(); ++k) EXPECT_EQ(square(k), smooth(k) >= 0 ? 1 : -1);
}

TEST(excitation, multisine_has_the_wanted_spectrum_and_low_peaks) {  // oracle: discrete Fourier sums, definition
    const Index count = 16;
    const Vector frequencies = Vector::LinSpaced(count, 1, 16);
    const Vector u = multisine(frequencies, 1, 1e-3);
    ASSERT_EQ(u.size(), 1000);
    EXPECT_NEAR(u.squaredNorm() / 1000, 1, 1e-12);
    for (Index line = 0; line <= 20; ++line) {
        Complex sum = 0;
        for (Index k = 0; k < 1000; ++k)
            sum += u(k) * std::polar(2e-3, -2 * std::numbers::pi * static_cast<double>(line * k) * 1e-3);
        const double amplitude = line >= 1 && line <= count ? std::sqrt(2.0 / count) : 0;
        EXPECT_NEAR(std::abs(sum), amplitude, 1e-12) << "line " << line;
    }
    // In phase the peak would be sqrt(2 F) = 5.66; Schroeder's phases keep it near that of one sine, 1.4.
    EXPECT_LT(u.lpNorm<Eigen::Infinity>(), 2);
}

TEST(excitation, rbs_tosses_a_coin_per_hold) {  // oracle: second route through the random stream
    RandomStream random(4), same(4);
    const Vector u = rbs(10, 4, random, 2, 3);
    ASSERT_EQ(u.size(), 10);
    for (Index k = 0; k < 10; k += 4) {
        const double level = same.uniform() < 0.5 ? 2 : 3;
        for (Index i = k; i < std::min<Index>(k + 4, 10); ++i) EXPECT_EQ(u(i), level);
    }
    const Vector fair = rbs(10000, 1, random);
    EXPECT_NEAR(fair.mean(), 0, 0.05);  // five standard errors of 10000 tosses
}

TEST(excitation, refusals_are_justified) {
    RandomStream random(1);
    EXPECT_THROW(sine(6, 1, 0.1), InvalidArgument);  // above half the sampling frequency
    EXPECT_NO_THROW(sine(5, 1, 0.1));
    EXPECT_THROW(sine(1, 1, 0), InvalidArgument);
    EXPECT_THROW(sine(1, 0.04, 0.1), InvalidArgument);
    EXPECT_THROW(sine(std::nan(""), 1, 0.1), InvalidArgument);
    EXPECT_THROW(chirp(1, 51, 10, 0.01), InvalidArgument);
    EXPECT_THROW(multisine(Vector(), 1, 0.1), InvalidArgument);
    EXPECT_THROW(multisine(Vector{{1.0, 2.0, 1.0}}, 1, 0.1), InvalidArgument);
    EXPECT_THROW(rbs(10, 0, random), InvalidArgument);
    EXPECT_THROW(rbs(0, 1, random), InvalidArgument);
}

}  // namespace test_excitation
