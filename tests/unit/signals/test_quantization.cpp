#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "numerics/signals/quantization.h"
#include "numerics/signals/random.h"

namespace test_quantization {

using namespace dynlab;

TEST(quantization, counts_the_values_of_long_signals) {  // oracle: a set of them
    for (const double step : {0.25, 0.001}) {
        const Vector x = (RandomStream(5).normal(50000).array() / step).round() * step;
        const std::set<double> values(x.begin(), x.end());
        const Quantization found = quantization_of(x);
        EXPECT_EQ(found.levels, static_cast<Index>(values.size()));
        EXPECT_NEAR(found.step, step, 1e-9);
    }
    const Quantization none = quantization_of(RandomStream(6).normal(50000));
    EXPECT_EQ(none.step, 0);
    EXPECT_GT(none.levels, 49000);
}

TEST(quantization, finds_no_grid_where_values_lie_unevenly) {  // oracle: by hand
    Vector x(40000);
    for (Index k = 0; k < x.size(); ++k) x[k] = std::sqrt(static_cast<double>(k % 7));
    const Quantization found = quantization_of(x);
    EXPECT_EQ(found.levels, 7);
    EXPECT_EQ(found.step, 0);
    EXPECT_EQ(quantization_of(Vector::Constant(1000, 3)).levels, 1);
}

}  // namespace test_quantization
