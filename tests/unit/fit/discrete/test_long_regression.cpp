#include "numerics/fit/discrete/long_regression.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/signals/random.h"

namespace test_long_regression {

using namespace dynlab;

constexpr Index kSamples = 2000;

/// x = 0.8 x(k-1) + u(k-1), and e added to its equation or a random walk of e to its output.
IdData simulated_data(double level, bool walk) {
    const Vector u = RandomStream(1).normal(kSamples), e = level * RandomStream(2).normal(kSamples);
    Vector y = Vector::Zero(kSamples);
    double x = 0, sum = 0;
    for (Index k = 0; k < kSamples; ++k) {
        if (k > 0) x = 0.8 * x + u[k - 1] + (walk ? 0 : e[k]);
        sum += e[k];
        y[k] = x + (walk ? sum : 0);
    }
    return {Matrix(y), Matrix(u), 1};
}

TEST(long_regression, variance_is_that_of_the_innovations) {  // oracle: the variance put in; 5 deviations of chance
    for (const bool walk : {false, true}) {
        const double variance = 0.25 * RandomStream(2).normal(kSamples).squaredNorm() / static_cast<double>(kSamples);
        const LongRegression regression(simulated_data(0.5, walk), 1);
        EXPECT_FALSE(regression.predicts_better_than(variance)) << walk;
        EXPECT_TRUE(regression.predicts_better_than(1.2 * variance)) << walk;
    }
}

TEST(long_regression, share_of_an_input_is_its_part_of_the_output) {  // oracle: the system with little noise
    const IdData data = simulated_data(0.01, false);
    const std::vector<Vector> share = LongRegression(data, 1).share(0);
    ASSERT_EQ(share.size(), 1u);
    EXPECT_LT((share[0] - data.experiments[0].y.col(0)).cwiseAbs().maxCoeff(), 0.2);
}

TEST(long_regression, filtered_data_lose_the_drift) {  // oracle: differences of a random walk are its increments
    const IdData data = simulated_data(0.5, true);
    const std::vector<IdData> filtered = LongRegression(data, 1).filtered_data(true);
    ASSERT_EQ(filtered.size(), 2u);
    const auto y = data.experiments[0].y.col(0), differenced = filtered[1].experiments[0].y.col(0);
    EXPECT_EQ(differenced[0], 0);
    EXPECT_LT((differenced.tail(kSamples - 1) - (y.tail(kSamples - 1) - y.head(kSamples - 1))).cwiseAbs().maxCoeff(),
              1e-12);
}

TEST(long_regression, records_that_are_too_short_reveal_nothing) {
    const IdData data = simulated_data(0.5, false).range(1, 12);
    const LongRegression regression(data, 1);
    EXPECT_FALSE(regression.predicts_better_than(1e9));
    EXPECT_TRUE(regression.share(0).empty());
}

}  // namespace test_long_regression
