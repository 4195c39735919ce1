#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "numerics/error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/signals/random.h"
#include "numerics/validation/robust_covariance.h"

namespace test_robust_covariance {

using namespace dynlab;

Matrix random_matrix(Index rows, Index columns, std::uint32_t seed) {
    const Vector numbers = RandomStream(seed).normal(rows * columns);
    return numbers.reshaped(rows, columns);
}

Vector ar1(Index N, double pole, std::uint32_t seed) {
    Vector e = RandomStream(seed).normal(N);
    for (Index k = 1; k < N; ++k) e[k] += pole * e[k - 1];
    return e;
}

// The definition, term by term: N/(N-d) H (sum_|l|<L (1 - |l|/L) sum_k h(k) h(k-l)') H'.
Matrix by_definition(const Matrix& H, const Matrix& Z, const Vector& e, Index L, const std::vector<Index>& lengths) {
    const Index d = Z.cols();
    Matrix S = Matrix::Zero(d, d);
    Index first = 0;
    for (const Index length : lengths) {
        for (Index k = first; k < first + length; ++k)
            for (Index l = first; l < first + length; ++l)
                if (std::abs(k - l) < L)
                    S += (1 - static_cast<double>(std::abs(k - l)) / static_cast<double>(L)) * e[k] * e[l] *
                         Z.row(k).transpose() * Z.row(l);
        first += length;
    }
    const double N = static_cast<double>(Z.rows());
    return N / (N - static_cast<double>(d)) * H * S * H.transpose();
}

TEST(robust_covariance, equals_its_definition) {  // oracle: the definition's double sum
    Matrix Z = random_matrix(150, 3, 1);
    for (Index k = 1; k < 150; ++k) Z.row(k) += 0.9 * Z.row(k - 1);
    const Vector e = ar1(150, 0.8, 2);
    const Matrix H = random_matrix(3, 3, 3);
    for (const std::vector<Index>& lengths : {std::vector<Index>{150}, std::vector<Index>{70, 50, 30}}) {
        const auto result = robust_covariance(H, Z, e, lengths);
        EXPECT_GT(result.bandwidth, 5);
        const Matrix expected = by_definition(H, Z, e, result.bandwidth, lengths);
        EXPECT_LT((result.covariance - expected).norm(), 1e-12 * expected.norm());
        EXPECT_LT((result.std - expected.diagonal().cwiseSqrt()).norm(), 1e-12 * result.std.norm());
    }
}

TEST(robust_covariance, sums_over_outputs_that_were_fitted_together) {  // oracle: the definition's double sum
    const Matrix first = random_matrix(150, 3, 1), second = random_matrix(150, 3, 8), H = random_matrix(3, 3, 3);
    const Vector e = ar1(150, 0.8, 2), f = 0.5 * e + ar1(150, 0.9, 9);
    Matrix Z(300, 3), products(150, 3);
    Z << first, second;
    Vector errors(300);
    errors << e, f;
    for (Index k = 0; k < 150; ++k) products.row(k) = first.row(k) * e[k] + second.row(k) * f[k];
    for (const std::vector<Index>& lengths : {std::vector<Index>{150}, std::vector<Index>{70, 50, 30}}) {
        const auto result = robust_covariance(H, Z, errors, lengths, 2);
        EXPECT_GT(result.bandwidth, 1);
        Matrix expected = by_definition(H, products, Vector::Ones(150), result.bandwidth, lengths);
        expected *= (300.0 / 297) / (150.0 / 147);
        EXPECT_LT((result.covariance - expected).norm(), 1e-12 * expected.norm());
    }
}

TEST(robust_covariance, is_whites_estimate_without_correlation) {  // oracle: definition with one term
    // Alternating instruments and errors of one size: products at lag one cancel in pairs.
    const Index N = 64;
    Matrix Z(N, 1);
    Vector e(N);
    for (Index k = 0; k < N; ++k) {
        Z(k, 0) = 1 + 0.01 * static_cast<double>(k % 7);
        e[k] = (k / 2) % 2 == 0 ? 1 : -1;
    }
    const auto result = robust_covariance(Matrix::Identity(1, 1), Z, e);
    ASSERT_EQ(result.bandwidth, 1);
    EXPECT_NEAR(result.covariance(0, 0), 64.0 / 63 * Z.squaredNorm(), 1e-10);
}

TEST(robust_covariance, follows_the_units_of_the_parameters) {  // oracle: invariance
    const Matrix Psi = random_matrix(300, 2, 4);
    const Vector e = ar1(300, 0.9, 5), units{{1e6, 1e-4}};
    const auto plain = robust_covariance(Psi, e), scaled = robust_covariance(Psi * units.asDiagonal(), e);
    EXPECT_EQ(plain.bandwidth, scaled.bandwidth);
    EXPECT_LT((scaled.std.cwiseProduct(units) - plain.std).cwiseQuotient(plain.std).norm(), 1e-12);
}

TEST(robust_covariance, least_squares_form_is_the_general_one) {  // oracle: second route
    const Matrix Psi = random_matrix(200, 3, 6);
    const Vector e = ar1(200, 0.5, 7);
    const Matrix H = (Psi.transpose() * Psi).inverse();
    EXPECT_LT((robust_covariance(Psi, e).covariance - robust_covariance(H, Psi, e).covariance).norm(), 1e-14);
}

TEST(robust_covariance, refuses_sizes_that_do_not_fit) {
    const Matrix Psi = random_matrix(10, 2, 1);
    EXPECT_THROW(robust_covariance(Psi, Vector::Ones(9)), InvalidArgument);
    EXPECT_THROW(robust_covariance(Psi, Vector::Ones(10), {4, 5}), InvalidArgument);
    EXPECT_THROW(robust_covariance(Psi, Vector::Ones(10), {10}, 2), InvalidArgument);
    EXPECT_THROW(robust_covariance(Psi, Vector::Ones(10), {}, 3), InvalidArgument);
    EXPECT_THROW(robust_covariance(Matrix(Psi.topRows(2)), Vector::Ones(2)), InvalidArgument);
    EXPECT_THROW(robust_covariance(Matrix::Identity(3, 3), Psi, Vector::Ones(10)), InvalidArgument);
}

}  // namespace test_robust_covariance
