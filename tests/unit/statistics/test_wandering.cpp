#include "numerics/statistics/wandering.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/signals/random.h"

namespace test_wandering {

using namespace dynlab;

Vector autoregression(Index N, double pole, std::uint32_t seed) {
    Vector x = RandomStream(seed).normal(N);
    for (Index k = 1; k < N; ++k) x[k] += pole * x[k - 1];
    return x;
}

int wandering_among(Index N, double pole) {
    int count = 0;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) count += wanders(autoregression(N, pole, seed)) ? 1 : 0;
    return count;
}

TEST(wandering, random_walks_and_lines_wander) {  // oracle: how the signals were made; 97 % of random walks
    EXPECT_GE(wandering_among(600, 1), 36);
    EXPECT_TRUE(wanders(Vector::LinSpaced(600, -1, 1) + 0.1 * RandomStream(3).normal(600)));
}

TEST(wandering, noise_that_forgets_does_not_wander) {  // oracle: how the signals were made
    EXPECT_EQ(wandering_among(600, 0), 0);
    EXPECT_LE(wandering_among(600, 0.9), 2);
}

TEST(wandering, short_or_odd_signals_do_not_wander) {
    EXPECT_FALSE(wanders(Vector::LinSpaced(239, 0, 1)));
    EXPECT_TRUE(wanders(Vector::LinSpaced(240, 0, 1)));
    Vector broken = Vector::LinSpaced(600, 0, 1);
    broken[300] = NAN;
    EXPECT_FALSE(wanders(broken));
    EXPECT_FALSE(wanders(Vector::Constant(600, 2)));
}

}  // namespace test_wandering
