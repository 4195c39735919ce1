#include <gtest/gtest.h>

#include "numerics/error.h"
#include "numerics/signals/correlation.h"
#include "numerics/signals/random.h"

namespace test_correlation {

using namespace dynlab;

double product(const Vector& x, const Vector& y, Index lag) {
    double sum = 0;
    for (Index k = 0; k < y.size(); ++k)
        if (k + lag >= 0 && k + lag < x.size()) sum += x[k + lag] * y[k];
    return sum;
}

TEST(correlation, both_ways_equal_the_definition) {  // oracle: the definition
    RandomStream random(3);
    const Vector x = random.normal(700), y = random.normal(700);
    for (const Index lags : {0, 3, 100, 101, 400, 699, 900}) {
        const Vector sums = lagged_products(x, y, lags);
        ASSERT_EQ(sums.size(), 2 * lags + 1);
        for (Index lag = -lags; lag <= lags; ++lag) EXPECT_NEAR(sums[lags + lag], product(x, y, lag), 1e-10) << lag;
    }
}

TEST(correlation, of_a_signal_with_itself_equals_the_definition) {  // oracle: the definition
    const Vector x = RandomStream(6).normal(5000);
    for (const Index lags : {0, 2, 25, 90, 120}) {
        const Vector sums = lagged_products(x, x, lags);
        for (Index lag = -lags; lag <= lags; ++lag) EXPECT_NEAR(sums[lags + lag], product(x, x, lag), 1e-9) << lag;
    }
}

/// Where several lags are summed at a time, their first and last samples are summed apart: each length and lag.
TEST(correlation, of_short_signals_equals_the_definition) {  // oracle: the definition
    RandomStream random(9);
    for (Index N = 1; N <= 40; ++N) {
        const Vector x = random.normal(N), y = random.normal(N);
        for (Index lags = 0; lags <= N + 1; ++lags) {
            const Vector sums = lagged_products(x, y, lags);
            for (Index lag = -lags; lag <= lags; ++lag)
                ASSERT_NEAR(sums[lags + lag], product(x, y, lag), 1e-12) << N << ", " << lags << ", " << lag;
        }
    }
}

TEST(correlation, behind_equals_the_definition) {  // oracle: the definition
    const Vector y = RandomStream(7).normal(3000), x = RandomStream(8).normal(2900);
    for (const Index last : {0, 1, 3, 4, 30}) {
        const Vector sums = products_behind(x, y.data() + 50, last);
        ASSERT_EQ(sums.size(), last + 1);
        for (Index lag = 0; lag <= last; ++lag) {
            double sum = 0;
            for (Index k = 0; k < x.size(); ++k) sum += x[k] * y[50 + k - lag];
            EXPECT_NEAR(sums[lag], sum, 1e-10) << lag;
        }
    }
}

TEST(correlation, finds_a_delay_at_its_positive_lag) {  // oracle: the delay made
    const Vector u = RandomStream(1).normal(500);
    Vector y = Vector::Zero(500);
    y.tail(493) = u.head(493);
    Index peak = 0;
    lagged_products(y, u, 20).maxCoeff(&peak);
    EXPECT_EQ(peak - 20, 7);
}

TEST(correlation, refuses_unequal_lengths) {
    EXPECT_THROW(lagged_products(Vector::Ones(3), Vector::Ones(4), 1), InvalidArgument);
    EXPECT_THROW(lagged_products(Vector(), Vector(), 1), InvalidArgument);
    EXPECT_THROW(lagged_products(Vector::Ones(3), Vector::Ones(3), -1), InvalidArgument);
}

}  // namespace test_correlation
