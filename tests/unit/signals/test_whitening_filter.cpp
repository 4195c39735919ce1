// Oracle: processes whose covariances are known in closed form, and the definition written out.
#include "numerics/signals/whitening_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/signals/random.h"

namespace test_whitening_filter {

using namespace dynlab;

/// x(k) = 1.2 x(k - 1) - 0.5 x(k - 2) + e(k), settled.
Vector second_order(Index N, std::uint32_t seed) {
    Vector x = RandomStream(seed).normal(N + 200);
    for (Index k = 2; k < x.size(); ++k) x[k] += 1.2 * x[k - 1] - 0.5 * x[k - 2];
    return x.tail(N);
}

TEST(whitening_filter, covariances_of_a_process_give_its_coefficients) {  // Yule and Walker's equations
    Vector r(5);
    r[0] = 1;
    r[1] = 1.2 / 1.5;
    for (Index k = 2; k < 5; ++k) r[k] = 1.2 * r[k - 1] - 0.5 * r[k - 2];
    const Vector a = whitening_filter(r, 4);
    EXPECT_TRUE(a.isApprox(Vector{{1, -1.2, 0.5, 0, 0}}, 1e-12)) << a.transpose();
}

TEST(whitening_filter, a_sine_is_told_by_two_coefficients) {  // x(k) = 2 cos(w) x(k - 1) - x(k - 2)
    Vector r(7);
    for (Index k = 0; k < 7; ++k) r[k] = std::cos(0.7 * static_cast<double>(k));
    const Vector a = whitening_filter(r, 6);
    EXPECT_NEAR(a[1], -2 * std::cos(0.7), 1e-9);
    EXPECT_NEAR(a[2], 1, 1e-9);
    EXPECT_TRUE(a.tail(4).isZero());
}

TEST(whitening_filter, chooses_the_order_of_the_process) {
    int right = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Vector a = whitening_filter_of(second_order(3000, seed).array() + 7, 10);
        if (a.size() != 3) continue;
        ++right;
        EXPECT_NEAR(a[1], -1.2, 0.08);
        EXPECT_NEAR(a[2], 0.5, 0.08);
    }
    EXPECT_GE(right, 17);
    EXPECT_LE(whitening_filter_of(RandomStream(1).normal(2000), 10).size(), 2);
    EXPECT_EQ(whitening_filter_of(Vector::Constant(100, 3), 10).size(), 1);
}

TEST(whitening_filter, filters_where_the_past_is_known) {
    const Vector x = RandomStream(3).normal(30), a{{1, -0.5, 0.25}}, y = filtered_past(a, x);
    ASSERT_EQ(y.size(), 28);
    for (Index k = 0; k < 28; ++k) EXPECT_NEAR(y[k], x[k + 2] - 0.5 * x[k + 1] + 0.25 * x[k], 1e-14);
}

}  // namespace test_whitening_filter
