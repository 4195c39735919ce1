#include <gtest/gtest.h>

#include "numerics/linalg/triangular_factor.h"

namespace test_triangular_factor {

using namespace dynlab;

TEST(triangular_factor, keeps_the_gram_matrix_of_all_rows) {  // oracle: the definition R'R = M'M
    const Matrix M = Matrix::Random(3000, 5);
    TriangularFactor factor(5);
    factor.add(M.topRows(2));
    factor.add(M.middleRows(2, 2500));
    factor.add(M.bottomRows(498));
    const Matrix& R = factor.R();
    EXPECT_LT((R.transpose() * R - M.transpose() * M).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(R.triangularView<Eigen::StrictlyLower>().toDenseMatrix().cwiseAbs().maxCoeff(), 0);
}

TEST(triangular_factor, fewer_rows_than_columns_leave_zeros) {  // oracle: the definition
    const Matrix M = Matrix::Random(2, 4);
    TriangularFactor factor(4);
    factor.add(M);
    EXPECT_LT((factor.R().transpose() * factor.R() - M.transpose() * M).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace test_triangular_factor
