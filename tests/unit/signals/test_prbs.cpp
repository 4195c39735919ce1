#include <gtest/gtest.h>

#include "numerics/error.h"
#include "numerics/signals/prbs.h"

namespace test_prbs {

using namespace dynlab;

/// Circular autocorrelation of one period at a lag.
double circular_correlation(const Vector& u, Index lag) {
    const Index rest = u.size() - lag;
    return u.head(rest).dot(u.tail(rest)) + u.tail(lag).dot(u.head(lag));
}

TEST(prbs, every_register_has_maximal_length) {  // oracle: definition; each window of n bits occurs once, never zeros
    for (int stages = 3; stages <= 18; ++stages) {
        const Vector u = prbs(stages, 1);
        const std::size_t period = (std::size_t{1} << stages) - 1;
        ASSERT_EQ(static_cast<std::size_t>(u.size()), period);
        std::vector<bool> seen(period + 1, false);
        std::size_t window = 0, distinct = 0;
        for (std::size_t k = 0; k < period + static_cast<std::size_t>(stages) - 1; ++k) {
            window = (2 * window + (u(static_cast<Index>(k % period)) > 0 ? 1 : 0)) & period;
            if (k + 1 < static_cast<std::size_t>(stages)) continue;
            if (!seen[window]) ++distinct;
            seen[window] = true;
        }
        EXPECT_EQ(distinct, period) << stages << " stages";
        EXPECT_FALSE(seen[0]) << stages << " stages";
    }
}

TEST(prbs, correlation_of_a_maximal_sequence) {  // oracle: analytic (Golomb 1967): L at lag zero, -1 elsewhere
    const Vector u = prbs(7, 1);
    EXPECT_EQ(circular_correlation(u, 0), 127);
    for (Index lag = 1; lag < 127; ++lag) EXPECT_EQ(circular_correlation(u, lag), -1);
    EXPECT_EQ(u.sum(), 1);  // one more one than zeros
}

TEST(prbs, begins_with_as_many_ones_as_stages) {  // oracle: definition, the register starts with all ones
    const Vector u = prbs(4, 1, 0, 1);
    // s = 1111, feedback s4 xor s3: worked by hand
    const Vector by_hand{{1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 0}};
    EXPECT_EQ(u, by_hand);
}

TEST(prbs, holds_and_levels) {  // oracle: second route, repeating the samples of the sequence with hold 1
    const Vector bits = prbs(5, 1, 0, 1), u = prbs(5, 3, -2, 5);
    ASSERT_EQ(u.size(), 31 * 3);
    for (Index k = 0; k < u.size(); ++k) EXPECT_EQ(u(k), bits(k / 3) > 0 ? 5 : -2);
}

TEST(prbs, refuses_what_it_cannot_make) {
    EXPECT_THROW(prbs(2, 1), InvalidArgument);
    EXPECT_THROW(prbs(19, 1), InvalidArgument);
    EXPECT_THROW(prbs(4, 0), InvalidArgument);
}

}  // namespace test_prbs
