#include "numerics/linalg/decompositions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace test_decompositions {

using namespace dynlab;

// oracle: tr A, |A|^2 and b'A b do not change with the basis
TEST(decompositions, tridiagonal_form_keeps_traces_and_quadratic_forms) {
    for (const Index n : {1, 2, 7, 30}) {
        Matrix A = Matrix::Random(n, n);
        A = (A + A.transpose()).eval();
        const Vector b = Vector::Random(n);
        const TridiagonalForm form = tridiagonal_form(A, b);
        Matrix T = form.diagonal.asDiagonal();
        for (Index i = 0; i + 1 < n; ++i) T(i, i + 1) = T(i + 1, i) = form.beside[i];
        EXPECT_NEAR(T.trace(), A.trace(), 1e-12 * n);
        EXPECT_NEAR(T.norm(), A.norm(), 1e-12 * n);
        EXPECT_NEAR(form.rotated.norm(), b.norm(), 1e-12);
        EXPECT_NEAR(form.rotated.dot(T * form.rotated), b.dot(A * b), 1e-11 * n);
        EXPECT_NEAR((T * form.rotated).squaredNorm(), (A * b).squaredNorm(), 1e-10 * n);
    }
}

double distance(const Matrix& a, const Matrix& b) {
    return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff();
}

/// With this rank: products of random factors.
Matrix random_matrix(Index rows, Index columns, Index rank) {
    return Matrix::Random(rows, rank) * Matrix::Random(rank, columns);
}

// oracle: definition, A = U diag(s) V' with orthonormal columns and falling s >= 0; any shape, rank and unit
TEST(decompositions, jacobi_svd_is_a_singular_value_decomposition) {
    for (const auto& [rows, columns] :
         std::vector<std::pair<Index, Index>>{{1, 1}, {5, 5}, {9, 4}, {4, 9}, {60, 60}, {1, 3}})
        for (const Index rank : {Index{0}, Index{1}, std::min(rows, columns) - 1, std::min(rows, columns)})
            for (const double unit : {1.0, 1e-200, 1e200}) {
                SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns) + ", rank " + std::to_string(rank));
                const Matrix A = unit * random_matrix(rows, columns, rank);
                const Index count = std::min(rows, columns);
                const auto [U, s, V] = jacobi_svd(A);
                ASSERT_EQ(U.cols(), count);
                ASSERT_EQ(V.cols(), count);
                EXPECT_LT(distance(U * s.asDiagonal() * V.transpose() / unit, A / unit),
                          1e-13 * (1 + (A / unit).norm()));
                EXPECT_LT(distance(U.transpose() * U, Matrix::Identity(count, count)), 1e-13);
                EXPECT_LT(distance(V.transpose() * V, Matrix::Identity(count, count)), 1e-13);
                for (Index i = 0; i < count; ++i) EXPECT_GE(s[i], i + 1 < count ? s[i + 1] : 0);
                EXPECT_LT(distance(singular_values(A) / unit, s / unit), 1e-13 * (1 + (A / unit).norm()));
            }
}

// oracle: analytic, for a matrix with columns in units that are far apart singular values keep their digits: those of
// D Q with a rotation Q are the entries of D
TEST(decompositions, jacobi_svd_keeps_the_digits_of_small_singular_values) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    const Matrix Q = (Matrix(3, 3) << c, -s, 0, s * c, c * c, -s, s * s, s * c, c).finished();
    const Vector expected{{1e8, 1.0, 1e-9}};
    const Vector found = jacobi_svd(expected.asDiagonal() * Q).s;
    for (Index i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / expected[i], 1, 1e-14);
}

// oracle: definition, of all least-squares solutions the one without a part in the null space
TEST(decompositions, the_shortest_solution_has_no_part_in_the_null_space) {
    const Matrix A = random_matrix(8, 6, 4), B = Matrix::Random(8, 2), X = minimum_norm_solution(A, B);
    EXPECT_LT(distance(A.transpose() * (A * X - B), Matrix::Zero(6, 2)), 1e-12);
    const Matrix null_space = full_orthogonal_basis(A.transpose()).rightCols(2);
    EXPECT_LT(distance(A * null_space, Matrix::Zero(8, 2)), 1e-12);
    EXPECT_LT(distance(null_space.transpose() * X, Matrix::Zero(2, 2)), 1e-12);
}

// oracle: definition
TEST(decompositions, the_inverse_of_a_complex_matrix_is_refused_for_a_singular_one) {
    const Eigen::MatrixXcd A = Eigen::MatrixXcd::Random(7, 7);
    const auto inverse = inverse_of_regular(A);
    ASSERT_TRUE(inverse);
    EXPECT_LT((A * *inverse - Eigen::MatrixXcd::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-12);
    Eigen::MatrixXcd singular = A;
    singular.col(3) = Complex(0.3, 2.0) * A.col(1) - A.col(6);
    EXPECT_FALSE(inverse_of_regular(singular));
}

}  // namespace test_decompositions
