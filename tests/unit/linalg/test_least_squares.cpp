#include "numerics/linalg/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_least_squares {

Matrix random_matrix(Index rows, Index columns) {
    RandomStream random(3);
    Matrix A(rows, columns);
    for (Index j = 0; j < columns; ++j) A.col(j) = random.normal(rows);
    return A;
}

TEST(least_squares, straight_line_by_hand) {  // oracle: analytic, y = 1, 2, 4 over x = 0, 1, 2 gives 5/6 + 3/2 x
    Matrix A(3, 2);
    A << 1, 0, 1, 1, 1, 2;
    const LeastSquares fit = solve_least_squares(A, Eigen::Vector3d(1, 2, 4));
    EXPECT_TRUE(fit.solution.isApprox(Eigen::Vector2d(5.0 / 6, 1.5), 1e-15));
    EXPECT_TRUE(fit.residuals.isApprox(Eigen::Vector3d(1, -2, 1) / 6, 1e-14));
    EXPECT_EQ(fit.rank, 2);
}

TEST(least_squares, residuals_are_orthogonal_to_the_columns) {  // oracle: the definition of the minimum
    const Matrix A = random_matrix(40, 5);
    const Vector b = RandomStream(8).normal(40);
    const LeastSquares fit = solve_least_squares(A, b);
    EXPECT_LT((A.transpose() * fit.residuals).norm(), 1e-13 * b.norm() * A.norm());
    EXPECT_TRUE((fit.inverse_gram * (A.transpose() * A)).isIdentity(1e-12));
}

TEST(least_squares, the_units_of_the_columns_do_not_matter) {  // oracle: second route, rescaled by powers of two
    const Matrix A = random_matrix(30, 3);
    const Vector b = RandomStream(8).normal(30), scale = Eigen::Vector3d(std::exp2(-300), 1, std::exp2(200));
    const LeastSquares plain = solve_least_squares(A, b), scaled = solve_least_squares(A * scale.asDiagonal(), b);
    EXPECT_TRUE((scale.asDiagonal() * scaled.solution).isApprox(plain.solution, 1e-14));
    EXPECT_NEAR(scaled.condition_number, plain.condition_number, 1e-12);
}

TEST(least_squares, condition_number_of_two_unit_columns) {  // oracle: analytic, sqrt((1 + c)/(1 - c)), c the cosine
    Matrix A(2, 2);
    A << 1, 0.6, 0, 0.8;
    EXPECT_NEAR(solve_least_squares(A, Eigen::Vector2d(1, 1)).condition_number, 2, 1e-14);
}

TEST(least_squares, equal_columns_are_reported) {  // oracle: analytic, the two share the weight
    Matrix A(3, 2);
    A << 1, 1, 2, 2, 3, 3;
    const LeastSquares fit = solve_least_squares(A, Eigen::Vector3d(2, 4, 6));
    EXPECT_EQ(fit.rank, 1);
    EXPECT_TRUE(std::isinf(fit.condition_number));
    EXPECT_TRUE(fit.solution.isApprox(Eigen::Vector2d(1, 1), 1e-14));
}

TEST(least_squares, refusals) {
    EXPECT_EQ(thrown_message([] { solve_least_squares(Matrix::Ones(3, 1), Vector::Ones(4)); }),
              "least squares: the matrix has 3 rows, but the right-hand side has 4 values");
    EXPECT_EQ(thrown_message([] { solve_least_squares(Matrix::Ones(2, 3), Vector::Ones(2)); }),
              "least squares: 2 equations cannot determine 3 parameters; more data are needed");
    EXPECT_EQ(thrown_message([] { solve_least_squares(Matrix::Ones(2, 1), Vector::Constant(2, NAN)); }),
              "least squares: the right-hand side contains a value that is not finite");
}

}  // namespace test_least_squares
}  // namespace dynlab
