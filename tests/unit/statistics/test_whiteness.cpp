#include "numerics/statistics/whiteness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "numerics/statistics/distributions.h"

namespace test_whiteness {

using namespace dynlab;

Vector ar1(Index N, double pole, std::uint32_t seed) {
    Vector e = RandomStream(seed).normal(N);
    for (Index k = 1; k < N; ++k) e[k] += pole * e[k - 1];
    return e;
}

TEST(whiteness, statistic_equals_ljung_and_box_formula) {  // oracle: the formula of Ljung and Box
    const Vector e = ar1(300, 0.1, 4);
    const auto test = whiteness_test({e});
    double Q = 0;
    for (Index lag = 1; lag <= 25; ++lag)
        Q += 300.0 * 302 * std::pow(test.correlation[lag], 2) / static_cast<double>(300 - lag);
    EXPECT_NEAR(test.statistic, Q, 1e-10);
    EXPECT_EQ(test.degrees, 25);
    EXPECT_NEAR(test.p_value, chi_squared_upper_tail(Q, 25), 1e-14);
    EXPECT_NEAR(test.bound, 2.5758293 / std::sqrt(300), 1e-7);
}

// Oracle: the definition; N of both data sets, products within each of them.
TEST(whiteness, products_do_not_cross_from_one_record_to_the_next) {
    const Vector one = ar1(120, 0.5, 1), other = ar1(80, 0.5, 2);
    const Vector a = one.array() - one.mean(), b = other.array() - other.mean();
    const auto test = whiteness_test({one, other}, {.lags = 10, .confidence = 0.99});
    for (Index lag = 0; lag <= 10; ++lag)
        EXPECT_NEAR(test.correlation[lag],
                    (a.tail(120 - lag).dot(a.head(120 - lag)) + b.tail(80 - lag).dot(b.head(80 - lag))) /
                        (a.squaredNorm() + b.squaredNorm()),
                    1e-12);
}

TEST(whiteness, colored_errors_are_rejected) {  // oracle: how the errors were made
    EXPECT_TRUE(whiteness_test({ar1(1000, 0, 3)}).white);
    EXPECT_FALSE(whiteness_test({ar1(1000, 0.3, 3)}).white);
}

TEST(whiteness, options_that_make_no_sense_are_refused) {
    EXPECT_THROW(whiteness_test({ar1(100, 0, 1)}, {.lags = 0, .confidence = 0.99}), InvalidArgument);
    EXPECT_THROW(whiteness_test({ar1(100, 0, 1)}, {.lags = 10, .confidence = 1}), InvalidArgument);
}

}  // namespace test_whiteness
