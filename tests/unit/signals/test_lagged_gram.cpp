#include <gtest/gtest.h>

#include <cmath>

#include "numerics/signals/lagged_gram.h"
#include "numerics/signals/random.h"

namespace test_lagged_gram {

using namespace dynlab;

/// The columns written out.
Matrix written_out(const std::vector<LaggedColumns>& columns, Index first, Index rows) {
    Matrix M(rows, 0);
    for (const LaggedColumns& one : columns)
        for (Index i = 0; i < one.count; ++i) {
            M.conservativeResize(rows, M.cols() + 1);
            for (Index k = 0; k < rows; ++k)
                M(k, M.cols() - 1) = one.weight * one.signal[first + k - one.first_lag - i];
        }
    return M;
}

void expect_products(const std::vector<LaggedColumns>& columns, Index first, Index rows) {  // oracle: the definition
    const Matrix M = written_out(columns, first, rows), expected = M.transpose() * M;
    const Matrix G = lagged_gram(columns, first, rows);
    ASSERT_EQ(G.rows(), expected.rows());
    const Vector size = expected.diagonal().cwiseSqrt();
    for (Index i = 0; i < G.rows(); ++i)
        for (Index j = 0; j < G.cols(); ++j)
            EXPECT_NEAR(G(i, j), expected(i, j), 1e-13 * size[i] * size[j]) << i << ' ' << j;
}

TEST(lagged_gram, equals_the_products_of_the_columns) {
    RandomStream random(4);
    for (const Index N : {9, 40, 2100, 5003}) {
        const Vector y = random.normal(N), u = random.normal(N), e = random.normal(N);
        expect_products({{y, 1, 3, -1}, {u, 0, 7, 1}, {e, 2, 1, 2}, {y, 0, 1, 1}}, 7, N - 7);
        expect_products({{y, 1, 0, -1}, {u, 2, 5, 1}, {y, 0, 1, 1}}, 6, N - 8);
    }
}

TEST(lagged_gram, keeps_its_digits_with_a_signal_that_grows) {
    Vector y(60);
    for (Index k = 0; k < 60; ++k) y[k] = std::pow(1.9, k) + 1e-3 * std::sin(static_cast<double>(k));
    expect_products({{y, 1, 12, -1}, {y, 0, 1, 1}}, 12, 48);
}

TEST(lagged_gram, is_zero_without_rows) {
    const Vector y = Vector::Ones(3);
    EXPECT_EQ(lagged_gram({{y, 1, 2, 1}}, 3, 0), Matrix::Zero(2, 2));
}

}  // namespace test_lagged_gram
