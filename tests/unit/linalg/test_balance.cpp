#include <gtest/gtest.h>

#include <cmath>

#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"

namespace test_balance {

using namespace dynlab;

TEST(balance, is_an_exact_similarity) {  // oracle: definition; powers of two make no rounding error
    const Matrix A = companion(Vector{{1, 100, 3750, 62500, 390625}});
    Matrix balanced = A;
    const Vector scale = balance(balanced);
    for (const double factor : scale) EXPECT_EQ(std::exp2(std::round(std::log2(factor))), factor);
    EXPECT_EQ(balanced, Matrix(scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal()));
}

TEST(balance, brings_rows_and_columns_to_like_norms) {  // oracle: definition (Parlett and Reinsch 1969)
    Matrix A = companion(Vector{{1, 5, 408, 416, 1e9}});
    const double norm_before = A.norm();
    balance(A);
    EXPECT_LT(A.norm(), 1e-3 * norm_before);
    for (Index i = 0; i < 4; ++i) {
        const double row = A.row(i).lpNorm<1>() - std::abs(A(i, i)), column = A.col(i).lpNorm<1>() - std::abs(A(i, i));
        EXPECT_LT(std::max(row, column) / std::min(row, column), 4.5) << "row " << i;
    }
}

TEST(balance, sees_neighbors_that_are_small_beside_the_diagonal) {  // oracle: by hand, both near sqrt(1e-18 1e18) = 1
    Matrix A{{2, 1e-18}, {1e18, 3}};
    balance(A);
    EXPECT_EQ(A.diagonal(), (Vector{{2, 3}}));
    for (const double neighbor : {A(0, 1), A(1, 0)}) {
        EXPECT_LT(neighbor, 2);
        EXPECT_GT(neighbor, 0.5);
    }
}

}  // namespace test_balance
