#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "numerics/statistics/robust_covariance.h"

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

// A with w = A e: row k predicts e(k) from at most p values before it, in the same data set.
Matrix whitening_matrix(const Autoregression& model, const std::vector<Index>& lengths, Index N) {
    Matrix A = Matrix::Identity(N, N);
    Index first = 0;
    for (const Index length : lengths) {
        for (Index k = 0; k < length; ++k) {
            const Vector& a = model.predictors[static_cast<std::size_t>(std::min(k, model.order()))];
            for (Index i = 0; i < a.size(); ++i) A(first + k, first + k - 1 - i) = a[i];
        }
        first += length;
    }
    return A;
}

// The definition, term by term: N/(N-d) sum_|l|<L (1 - |l|/L) sum_k v(k) v(k-l)', v(k) = H sum_i x_i(k) w_i(k), with
// the instruments x = A'^-1 z of each output.
Matrix by_definition(const Matrix& H, const Matrix& Z, const Vector& e, const RobustCovariance& result,
                     const std::vector<Index>& lengths) {
    const Index outputs = static_cast<Index>(result.whitening.size()), N = Z.rows() / outputs, d = Z.cols();
    Matrix V = Matrix::Zero(N, d);
    for (Index i = 0; i < outputs; ++i) {
        const Matrix A = whitening_matrix(result.whitening[static_cast<std::size_t>(i)], lengths, N);
        const Vector w = A * e.segment(i * N, N);
        V += w.asDiagonal() * Matrix(A.transpose().inverse() * Z.middleRows(i * N, N)) * H.transpose();
    }
    const Index L = result.bandwidth;
    Matrix S = Matrix::Zero(d, d);
    Index first = 0;
    for (const Index length : lengths) {
        for (Index k = first; k < first + length; ++k)
            for (Index l = first; l < first + length; ++l)
                if (std::abs(k - l) < L)
                    S += (1 - static_cast<double>(std::abs(k - l)) / static_cast<double>(L)) * V.row(k).transpose() *
                         V.row(l);
        first += length;
    }
    const double values = static_cast<double>(Z.rows());
    return values / (values - static_cast<double>(d)) * S;
}

TEST(robust_covariance, equals_its_definition) {  // oracle: the definition's double sum, with dense matrices
    Matrix Z = random_matrix(150, 3, 1);
    for (Index k = 1; k < 150; ++k) Z.row(k) += 0.9 * Z.row(k - 1);
    // The size of the errors rises and falls slowly: terms that are white, but depend on each other, are left.
    const Vector size = Vector::LinSpaced(150, 0, 6).array().sin() + 1.5;
    const Vector e = ar1(150, 0.8, 2).cwiseProduct(size);
    const Matrix H = random_matrix(3, 3, 3);
    for (const std::vector<Index>& lengths : {std::vector<Index>{150}, std::vector<Index>{70, 50, 30}}) {
        const auto result = robust_covariance(H, Z, e, lengths);
        EXPECT_GT(result.bandwidth, 1);
        EXPECT_GT(result.whitening.front().order(), 0);
        const Matrix expected = by_definition(H, Z, e, result, lengths);
        EXPECT_LT((result.covariance - expected).norm(), 1e-12 * expected.norm());
        EXPECT_LT((result.std - expected.diagonal().cwiseSqrt()).norm(), 1e-12 * result.std.norm());
    }
}

TEST(robust_covariance, sums_over_outputs_that_were_fitted_together) {  // oracle: the definition's double sum
    const Vector e = ar1(150, 0.8, 2), f = 0.5 * e + ar1(150, 0.9, 9);
    const Matrix Z = random_matrix(300, 3, 1), H = random_matrix(3, 3, 3);
    Vector errors(300);
    errors << e, f;
    for (const std::vector<Index>& lengths : {std::vector<Index>{150}, std::vector<Index>{70, 50, 30}}) {
        const auto result = robust_covariance(H, Z, errors, lengths, 2);
        const Matrix expected = by_definition(H, Z, errors, result, lengths);
        EXPECT_LT((result.covariance - expected).norm(), 1e-12 * expected.norm());
    }
}

// Oracle: Z' R Z, R(k, l) the autocovariance of a second-order autoregression, in closed form by its impulse response.
TEST(robust_covariance, knows_the_variance_of_sums_of_colored_errors) {
    constexpr Index kN = 1000, kRuns = 200;
    Matrix Z(kN, 2);
    for (Index k = 0; k < kN; ++k) Z.row(k) << std::sin(0.05 * static_cast<double>(k)), 1;
    Vector response(4000);  // of 1/(1 - 1.97 q^-1 + 0.98 q^-2)
    for (Index k = 0; k < response.size(); ++k)
        response[k] = k == 0 ? 1 : 1.97 * response[k - 1] - (k > 1 ? 0.98 * response[k - 2] : 0);
    Vector r(kN);
    for (Index l = 0; l < kN; ++l) r[l] = response.head(4000 - l).dot(response.tail(4000 - l));
    Matrix R(kN, kN);
    for (Index k = 0; k < kN; ++k)
        for (Index l = 0; l < kN; ++l) R(k, l) = r[std::abs(k - l)];
    const Vector expected = (Z.transpose() * R * Z).diagonal();
    Vector mean = Vector::Zero(2);
    for (std::uint32_t run = 1; run <= kRuns; ++run) {
        Vector e = RandomStream(run).normal(kN + 2000);
        for (Index k = 2; k < e.size(); ++k) e[k] += 1.97 * e[k - 1] - 0.98 * e[k - 2];
        mean += robust_covariance(Matrix::Identity(2, 2), Z, e.tail(kN)).covariance.diagonal() / kRuns;
    }
    EXPECT_NEAR(mean[0] / expected[0], 1, 0.1);
    EXPECT_NEAR(mean[1] / expected[1], 1, 0.1);
}

TEST(robust_covariance, is_whites_estimate_without_correlation) {  // oracle: definition with one term
    const Index N = 64;
    Matrix Z(N, 1);
    for (Index k = 0; k < N; ++k) Z(k, 0) = 1 + 0.01 * static_cast<double>(k % 7);
    // An error here and there, far apart: nothing that an autoregression or a window of lags could use.
    Vector e = Vector::Zero(N);
    e[5] = 1, e[23] = -2, e[50] = 1.5;
    const auto result = robust_covariance(Matrix::Identity(1, 1), Z, e);
    ASSERT_EQ(result.bandwidth, 1);
    ASSERT_EQ(result.whitening.front().order(), 0);
    EXPECT_NEAR(result.covariance(0, 0), 64.0 / 63 * (Z.cwiseProduct(e)).squaredNorm(), 1e-10);
}

TEST(robust_covariance, follows_the_units_of_the_parameters) {  // oracle: invariance
    const Matrix Psi = random_matrix(300, 2, 4);
    const Vector e = ar1(300, 0.9, 5), units{{1e6, 1e-4}};
    const auto plain = robust_covariance(Psi, e), scaled = robust_covariance(Psi * units.asDiagonal(), e);
    EXPECT_EQ(plain.bandwidth, scaled.bandwidth);
    EXPECT_LT((scaled.std.cwiseProduct(units) - plain.std).cwiseQuotient(plain.std).norm(), 1e-12);
}

TEST(robust_covariance, least_squares_form_is_the_general_one_for_errors_that_were_not_fitted) {
    // Oracle: each sample's error in the fit to all others, which is e over one minus the leverage.
    constexpr Index kN = 200;
    const Matrix Psi = random_matrix(kN, 3, 6);
    const Vector y = ar1(kN, 0.5, 7).cwiseProduct(Psi.col(0).cwiseAbs());  // large where it matters: no floor
    const Vector e = y - Psi * Psi.colPivHouseholderQr().solve(y);
    Vector left_out(kN);
    for (Index k = 0; k < kN; ++k) {
        Matrix others = Psi;
        Vector rest = y;
        others.row(k).setZero(), rest[k] = 0;
        left_out[k] = y[k] - Psi.row(k) * others.colPivHouseholderQr().solve(rest);
    }
    const Matrix H = (Psi.transpose() * Psi).inverse();
    const double robust = robust_covariance(Psi, e).std[0], expected = robust_covariance(H, Psi, left_out).std[0];
    EXPECT_NEAR(robust, expected, 1e-10 * expected);
}

// Oracle: the scatter of 2000 least-squares fits to 30 samples, whose errors have no color and one size.
TEST(robust_covariance, intervals_of_few_samples_hold_the_truth) {
    constexpr Index kRuns = 2000;
    Matrix Psi(30, 2);
    for (Index k = 0; k < 30; ++k) Psi.row(k) << std::exp(-0.2 * static_cast<double>(k)), k % 6 < 3 ? 1 : -1;
    const auto solver = Psi.colPivHouseholderQr();
    Index inside = 0;
    for (std::uint32_t run = 1; run <= kRuns; ++run) {
        const Vector y = RandomStream(run).normal(30), theta = solver.solve(y);
        inside += (theta.cwiseAbs().array() < 1.96 * robust_covariance(Psi, y - Psi * theta).std.array()).count();
    }
    EXPECT_GT(static_cast<double>(inside) / (2 * kRuns), 0.92);
    EXPECT_LT(static_cast<double>(inside) / (2 * kRuns), 0.98);
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
