#include <gtest/gtest.h>

#include <complex>

#include "numerics/linalg/types.h"

namespace test_products {

using namespace dynlab;
using Eigen::MatrixXcd;

template <class Number>
using MatrixOf = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

template <class Number>
MatrixOf<Number> entries(Index rows, Index cols, double first) {
    MatrixOf<Number> A(rows, cols);
    for (Index k = 0; k < A.size(); ++k) {
        const double x = std::sin(first + 1.7 * static_cast<double>(k));
        if constexpr (std::is_same_v<Number, double>)
            A(k % rows, k / rows) = x;
        else
            A(k % rows, k / rows) = {x, std::cos(first * static_cast<double>(k))};
    }
    return A;
}

/// A B entry by entry.
template <class Number>
MatrixOf<Number> by_entries(const MatrixOf<Number>& A, const MatrixOf<Number>& B) {
    MatrixOf<Number> C = MatrixOf<Number>::Zero(A.rows(), B.cols());
    for (Index i = 0; i < A.rows(); ++i)
        for (Index j = 0; j < B.cols(); ++j)
            for (Index k = 0; k < A.cols(); ++k) C(i, j) += A(i, k) * B(k, j);
    return C;
}

template <class Actual, class Number>
void expect_same(const Actual& actual, const MatrixOf<Number>& expected, const char* what) {
    ASSERT_EQ(actual.rows(), expected.rows()) << what;
    ASSERT_EQ(actual.cols(), expected.cols()) << what;
    EXPECT_LT((MatrixOf<Number>(actual) - expected).norm(), 1e-13 * (1 + expected.norm())) << what;
}

// Oracle: sums entry by entry. Small and large sizes take different routes.
template <class Number>
void check_products(Index rows, Index depth, Index cols) {
    const MatrixOf<Number> A = entries<Number>(rows, depth, 0.3), B = entries<Number>(depth, cols, 0.9);
    const MatrixOf<Number> expected = by_entries<Number>(A, B), At = A.transpose(), Bt = B.transpose(),
                           Ah = A.adjoint(), wide = entries<Number>(rows + 3, depth + 2, 0.1);
    expect_same(MatrixOf<Number>(A * B), expected, "A B");
    expect_same(MatrixOf<Number>(At.transpose() * B), expected, "transposed left");
    expect_same(MatrixOf<Number>(A * Bt.transpose()), expected, "transposed right");
    expect_same(MatrixOf<Number>(At.transpose() * Bt.transpose()), expected, "both transposed");
    expect_same(MatrixOf<Number>(Ah.adjoint() * B), expected, "adjoint");
    expect_same(MatrixOf<Number>((Number(2) * A) * (-B)), MatrixOf<Number>(Number(-2) * expected), "factors");
    expect_same(MatrixOf<Number>((A + A) * B), MatrixOf<Number>(Number(2) * expected), "an expression");
    expect_same(MatrixOf<Number>((A * B).transpose()), MatrixOf<Number>(expected.transpose()), "of the product");
    const auto block = wide.block(2, 1, rows, depth);
    expect_same(MatrixOf<Number>(block * B), by_entries<Number>(MatrixOf<Number>(block), B), "a block");
    MatrixOf<Number> target = MatrixOf<Number>::Ones(rows + 1, cols + 1);
    target.bottomRightCorner(rows, cols).noalias() += A * B;
    expect_same(target.bottomRightCorner(rows, cols), MatrixOf<Number>(expected.array() + Number(1)),
                "added to a block");
    target.bottomRightCorner(rows, cols) -= A * B;
    expect_same(target, MatrixOf<Number>(MatrixOf<Number>::Ones(rows + 1, cols + 1)), "taken off, the rest untouched");
    Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_rows = A * B;
    expect_same(by_rows, expected, "into rows");
    const MatrixOf<Number> square = entries<Number>(rows, rows, 0.5);
    MatrixOf<Number> own = square;
    own = own * own;
    expect_same(own, by_entries<Number>(square, square), "into a factor");
    for (Index j = 0; j < cols; ++j)
        expect_same((A * B.col(j)).eval(), MatrixOf<Number>(expected.col(j)), "a vector on the right");
    for (Index i = 0; i < rows; ++i)
        expect_same((A.row(i) * B).eval(), MatrixOf<Number>(expected.row(i)), "a row on the left");
    expect_same((A * Bt.row(0).transpose()).eval(), MatrixOf<Number>(expected.col(0)), "a vector in steps");
    MatrixOf<Number> rows_of = MatrixOf<Number>::Zero(3, rows);
    rows_of.row(1) = (A * B.col(0)).transpose();
    expect_same(rows_of.row(1), MatrixOf<Number>(expected.col(0).transpose()), "a vector into a row");
    expect_same((A * (B.col(0) + B.col(0))).eval(), MatrixOf<Number>(Number(2) * expected.col(0)), "a sum of vectors");
}

TEST(products, are_the_sums_of_their_entries) {
    check_products<double>(2, 3, 4);
    check_products<double>(1, 5, 1);
    check_products<double>(30, 17, 23);
    check_products<Complex>(3, 2, 4);
    check_products<Complex>(25, 12, 9);
}

TEST(products, of_nothing_are_zero) {
    const Matrix A(3, 0), B(0, 2), none(0, 3);
    EXPECT_TRUE(Matrix(A * B).isZero(0));
    EXPECT_EQ(Matrix(none * Matrix::Ones(3, 2)).rows(), 0);
    EXPECT_TRUE(Vector(A * Vector(0)).isZero(0));
}

TEST(products, go_into_parts_of_complex_numbers) {
    const Matrix A = entries<double>(4, 3, 0.2), B = entries<double>(3, 5, 0.4);
    MatrixXcd both = MatrixXcd::Zero(4, 5);
    both.real() = A * B;
    both.imag() = -(A * B);
    expect_same(both, MatrixXcd(by_entries<double>(A, B).cast<Complex>() * Complex(1, -1)), "parts");
}

}  // namespace test_products
