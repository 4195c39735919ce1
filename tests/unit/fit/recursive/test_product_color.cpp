#include <gtest/gtest.h>

#include "numerics/fit/recursive/product_color.h"

namespace test_product_color {

using namespace dynlab;

constexpr double kTimes = 4, kRows = 1000, kOpen = 200, kVariance = 0.25;

/// Whole blocks hold kTimes what white errors would give.
ProductSums larger_sums(double blocks) {
    const Matrix Z = Matrix{{1, 2, 0.5}, {0, 1, -1}, {2, 0, 1}, {1, 1, 3}};
    const Matrix gram = Z.transpose() * Z;
    return {gram, kTimes * kVariance * (1 - kOpen / kRows) * gram, kRows, blocks, kVariance, kOpen};
}

// Oracle: James and Stein's rule for a T that is kTimes the identity, by hand.
TEST(product_color, is_drawn_towards_white_errors_by_the_part_of_chance) {
    for (const double blocks : {20.0, 1e6}) {
        const double distance = 3 * (kTimes - 1) * (kTimes - 1), chance = 3 * 4 / blocks;
        const double expected = 1 + (1 - chance / distance) * (kTimes - 1);
        EXPECT_TRUE(color_ratio(larger_sums(blocks)).isApprox(expected * Matrix::Identity(3, 3), 1e-12)) << blocks;
    }
}

TEST(product_color, of_errors_that_say_nothing_is_that_of_white_ones) {
    ProductSums few_blocks = larger_sums(0.4), no_blocks = larger_sums(0), no_errors = larger_sums(20),
                no_excitation = larger_sums(20);
    no_errors.variance = 0;
    no_excitation.gram.setZero();
    for (const ProductSums& sums : {few_blocks, no_blocks, no_errors, no_excitation})
        EXPECT_TRUE(color_ratio(sums).isIdentity(1e-12));
}

}  // namespace test_product_color
