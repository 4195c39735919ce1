#include "numerics/signals/unwrap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/thrown_message.h"

namespace test_unwrap {

using namespace dynlab;

using testing::HasSubstr;

Vector wrapped(const Vector& x, double period, double low) {
    return x.unaryExpr([=](double v) { return v - period * std::floor((v - low) / period); });
}

TEST(unwrap, wrapped_signal_is_restored) {  // oracle: the signal before it was wrapped
    Vector x = Vector::LinSpaced(500, 0, 1500);
    for (Index k = 0; k < x.size(); ++k) x[k] += 200 * std::sin(0.05 * static_cast<double>(k));
    EXPECT_LT((unwrap(wrapped(x, 360, -180), 360) - x).cwiseAbs().maxCoeff(), 1e-9);
    const Vector radians = x * std::numbers::pi / 180;
    EXPECT_LT((unwrap(wrapped(radians, 2 * std::numbers::pi, 0), 2 * std::numbers::pi) - radians).cwiseAbs().maxCoeff(),
              1e-9);
}

TEST(unwrap, bad_arguments_are_refused) {
    EXPECT_THAT(thrown_message([] { unwrap(Vector::Ones(3), 0); }), HasSubstr("period must be a positive number"));
    EXPECT_THAT(thrown_message([] { unwrap(Vector::Constant(3, std::nan("")), 360); }), HasSubstr("unwrap"));
}

}  // namespace test_unwrap
