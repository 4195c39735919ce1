#include "numerics/statistics/wrapped_period.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/signals/random.h"

namespace test_wrapped_period {

using namespace dynlab;

Vector wrapped(const Vector& x, double period, double low) {
    return x.unaryExpr([=](double v) { return v - period * std::floor((v - low) / period); });
}

TEST(wrapped_period, periods_are_recognized_and_other_signals_are_not) {  // oracle: what was wrapped
    const Vector noise = RandomStream(1).normal(1000), periods{{360.0, 2 * std::numbers::pi}};
    Vector slow = noise;
    for (Index k = 1; k < slow.size(); ++k) slow[k] = 0.99 * slow[k - 1] + noise[k];
    slow *= 300 / slow.cwiseAbs().maxCoeff();
    EXPECT_EQ(wrapped_period(wrapped(slow, 360, -180), periods), 360);
    EXPECT_EQ(wrapped_period(wrapped(slow, 360, 0), periods), 360);
    EXPECT_FALSE(wrapped_period(slow * (179 / slow.cwiseAbs().maxCoeff()), periods).has_value());
    const Vector square = noise.unaryExpr([](double v) { return v > 0 ? 180.0 : -180.0; });
    EXPECT_FALSE(wrapped_period(square, periods).has_value());
    Vector sine(1000), fast = noise;  // both jump from end to end, and unwrapping does not help
    for (Index k = 0; k < sine.size(); ++k) sine[k] = 175 * std::sin(2.1 * static_cast<double>(k)) + noise[k];
    EXPECT_FALSE(wrapped_period(sine, periods).has_value());
    for (Index k = 2; k < fast.size(); ++k) fast[k] = 1.5 * fast[k - 1] - 0.8 * fast[k - 2] + noise[k];
    fast *= 400 / fast.cwiseAbs().maxCoeff();  // steps of up to half a turn
    EXPECT_EQ(wrapped_period(wrapped(fast, 360, 0) + noise, periods), 360);
}

}  // namespace test_wrapped_period
