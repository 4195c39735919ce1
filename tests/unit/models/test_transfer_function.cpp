#include "numerics/models/transfer_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/thrown_message.h"

namespace dynlab {
namespace test_transfer_function {

Vector from(std::initializer_list<double> values) {
    return Eigen::Map<const Vector>(values.begin(), static_cast<Index>(values.size()));
}

const TransferFunction kSecondOrder(from({2}), from({1, 4, 3}));

TEST(transfer_function, is_made_monic_and_stripped) {  // oracle: definition
    const TransferFunction G(from({0, 4}), from({0, 2, 8, 6}));
    EXPECT_EQ(G.num(), from({2}));
    EXPECT_EQ(G.den(), from({1, 4, 3}));
    EXPECT_TRUE(G.stable());
    EXPECT_DOUBLE_EQ(G.dc_gain(), 2.0 / 3);
    EXPECT_EQ(TransferFunction(from({0}), from({1, 1})).zeros().size(), 0);
}

TEST(transfer_function, algebra_agrees_with_arithmetic_of_values) {  // oracle: second route, at one point
    const TransferFunction s = TransferFunction::variable(), H(from({1, 5}), from({1, 2}));
    const Complex p(0.3, 1.7), g = kSecondOrder.at(p), h = H.at(p);
    const auto close = [&](const TransferFunction& G, Complex value) {
        return std::abs(G.at(p) - value) < 1e-14 * std::abs(value);
    };
    EXPECT_TRUE(close(kSecondOrder + H, g + h));
    EXPECT_TRUE(close(kSecondOrder - H, g - h));
    EXPECT_TRUE(close(kSecondOrder * H, g * h));
    EXPECT_TRUE(close(kSecondOrder / H, g / h));
    EXPECT_TRUE(close(kSecondOrder.with_delay(0.4) / H.with_delay(0.1), g / h * std::exp(-0.3 * p)));
    EXPECT_EQ((kSecondOrder.with_delay(0.4) / H.with_delay(0.4)).delay(), 0);
    EXPECT_TRUE(close(pow(s, 3), p * p * p));
    EXPECT_TRUE(close(pow(H, -2), 1.0 / (h * h)));
    EXPECT_TRUE(close(feedback(kSecondOrder, H), g / (1.0 + g * h)));
    EXPECT_TRUE(close(feedback(kSecondOrder, H, +1), g / (1.0 - g * h)));
    EXPECT_TRUE(close(kSecondOrder.with_delay(0.4) * H.with_delay(0.1), g * h * std::exp(-0.5 * p)));
}

TEST(transfer_function, a_gain_fits_any_sampling_time) {  // oracle: definition
    const TransferFunction z = TransferFunction::variable(0.1), one;
    EXPECT_EQ((one / (z - one)).Ts(), 0.1);
    EXPECT_NE(thrown_message([&] { z + kSecondOrder; }), "");
}

TEST(transfer_function, dc_gain_and_stability_at_the_border) {  // oracle: analytic
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto gain = [](const Vector& num, const Vector& den, double Ts = 0) {
        return TransferFunction(num, den, Ts).dc_gain();
    };
    EXPECT_EQ(gain(from({1}), from({1, 0})), kInfinity);
    EXPECT_EQ(gain(from({-1}), from({1, 0})), -kInfinity);
    EXPECT_EQ(gain(from({3}), from({1, -2, 0})), -kInfinity);     // 3/(s (s - 2)): the tangent falls
    EXPECT_EQ(gain(from({-3}), from({1, -1, 0, 0})), kInfinity);  // -3/(s^2 (s - 1))
    EXPECT_EQ(gain(from({1}), from({1, -1}), 0.1), kInfinity);
    EXPECT_EQ(gain(from({-1}), from({1, -2, 1}), 0.1), -kInfinity);
    EXPECT_EQ(gain(from({1}), from({1, -3, 2}), 0.1), -kInfinity);  // 1/((z - 1)(z - 2))
    EXPECT_TRUE(std::isnan(gain(from({1, 0}), from({1, 0}))));
    EXPECT_FALSE(TransferFunction(from({1}), from({1, 0})).stable());
    EXPECT_FALSE(TransferFunction(from({1}), from({1, -1}), 0.1).stable());
    EXPECT_TRUE(TransferFunction(from({1}), from({1, -0.5}), 0.1).stable());
    EXPECT_DOUBLE_EQ(TransferFunction(from({1}), from({1, -0.5}), 0.1).dc_gain(), 2);
}

TEST(transfer_function, damping_of_known_poles) {                                 // oracle: analytic
    const auto rows = damping(TransferFunction(from({1}), from({1, 2, 10, 0})));  // s (s^2 + 2s + 10)
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].natural_frequency, 0);
    EXPECT_TRUE(std::isnan(rows[0].damping_ratio));
    EXPECT_NEAR(rows[1].natural_frequency, std::sqrt(10.0), 1e-14);
    EXPECT_NEAR(rows[1].damping_ratio, 1 / std::sqrt(10.0), 1e-14);
    EXPECT_NEAR(rows[1].time_constant, 1, 1e-14);
    const auto discrete = damping(TransferFunction(from({1}), from({1, -std::exp(-0.2)}), 0.1));
    EXPECT_NEAR(discrete[0].natural_frequency, 2, 1e-13);
    EXPECT_NEAR(discrete[0].time_constant, 0.5, 1e-13);
}

TEST(transfer_function, bandwidth_of_known_systems) {  // oracle: analytic
    // |2/(3 - w^2 + 4jw)|^2 = 4/9 / r with r = 10^0.3: w^4 + 10 w^2 + 9 (1 - r) = 0.
    const double r = std::pow(10, 0.3), expected = std::sqrt(-5 + std::sqrt(25 - 9 * (1 - r)));
    EXPECT_NEAR(bandwidth(kSecondOrder), expected, 1e-12);
    EXPECT_NEAR(bandwidth(TransferFunction(from({1}), from({1e6, 1}))), std::sqrt(r - 1) * 1e-6, 1e-18);
    EXPECT_TRUE(
        std::isinf(bandwidth(TransferFunction(from({1, 2}), from({1, 1})) + TransferFunction(from({9}), from({1})))));
    EXPECT_TRUE(std::isnan(bandwidth(TransferFunction(from({1}), from({1, 0})))));
}

TEST(transfer_function, bandwidth_ends_at_a_narrow_notch) {  // oracle: analytic, (1 - x)^2 (10^0.3 - 1) = 4e-6 x
    const TransferFunction G(from({1, 0, 1}), from({1, 2e-3, 1}));
    const double c = 4e-6 / (std::pow(10, 0.3) - 1), x = (2 + c - std::sqrt((2 + c) * (2 + c) - 4)) / 2;
    EXPECT_NEAR(bandwidth(G), std::sqrt(x), 1e-9);
}

TEST(transfer_function, bandwidth_of_a_sampled_lag) {  // oracle: analytic, (1-p)^2/(1 - 2 p cos(w Ts) + p^2) = 10^-0.3
    const double p = 0.8, Ts = 0.1, cosine = (1 + p * p - (1 - p) * (1 - p) * std::pow(10, 0.3)) / (2 * p);
    EXPECT_NEAR(bandwidth(TransferFunction(from({1 - p}), from({1, -p}), Ts)), std::acos(cosine) / Ts, 1e-11);
}

TEST(transfer_function, text_shows_a_fraction) {  // oracle: by hand
    EXPECT_EQ(to_text(kSecondOrder), "      2\n-------------\ns^2 + 4 s + 3");
    EXPECT_EQ(to_text(TransferFunction(from({-4, 0.5}), from({1, 1, 4}), 0, 8)),
              "          -4 s + 0.5\nexp(-8 s) -----------\n          s^2 + s + 4");
    EXPECT_EQ(to_text(TransferFunction(from({1, 0}), from({1, -1}), 0.1, 0.2)),
              "       z\nz^-2 -----   Ts = 0.1 s\n     z - 1");
}

TEST(transfer_function, says_what_is_wrong) {
    EXPECT_EQ(thrown_message([] {
                  TransferFunction(from({1}), from({0, 0}));
              }),
              "transfer function: the denominator is zero");
    EXPECT_EQ(thrown_message([] { TransferFunction(Vector(), from({1})); }),
              "transfer function: the numerator has no coefficients");
    EXPECT_EQ(thrown_message([] { TransferFunction(from({NAN}), from({1})); }),
              "transfer function: the numerator contains a coefficient that is not finite");
    EXPECT_EQ(thrown_message([] { TransferFunction(from({1}), from({1}), 0, -1); }),
              "transfer function: the delay must be nonnegative, but it is -1 s");
    EXPECT_EQ(thrown_message([] { TransferFunction(from({1}), from({1}), 0.1, 0.25); }),
              "transfer function: in discrete time the delay must be a multiple of Ts = 0.1 s, but it is 0.25 s");
    EXPECT_NE(thrown_message([] { kSecondOrder + kSecondOrder.with_delay(1); }).find("pade(G, n)"), std::string::npos);
    EXPECT_NE(thrown_message([] { kSecondOrder / kSecondOrder.with_delay(1); }), "");
    EXPECT_NE(thrown_message([] { kSecondOrder / TransferFunction(from({0}), from({1})); }), "");
}

TEST(transfer_function, discrete_sums_know_different_delays) {  // oracle: the values of both at a point
    const TransferFunction a(from({1, 0.5}), from({1, -0.8}), 0.1, 0.5), b(from({2}), from({1, 0.3}), 0.1, 0.2);
    const Complex z(0.4, 0.9);
    for (const TransferFunction& sum : {a + b, b + a}) {
        EXPECT_NEAR(std::abs(sum.at(z) - a.at(z) - b.at(z)), 0, 1e-12);
        EXPECT_DOUBLE_EQ(sum.delay(), 0.2);
    }
    EXPECT_NEAR(std::abs((TransferFunction(from({3}), from({1})) - a).at(z) - 3.0 + a.at(z)), 0, 1e-12);
}

}  // namespace test_transfer_function
}  // namespace dynlab
