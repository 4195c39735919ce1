#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "numerics/fit/recursive/instrument_array.h"
#include "numerics/signals/random.h"

namespace test_instrument_array {

using namespace dynlab;

constexpr int kCount = 3;

struct Rows {
    Matrix Z, Phi;
    Vector y;
};
Rows random_rows(Index N) {
    RandomStream random(5);
    Rows rows{Matrix(N, kCount), Matrix(N, kCount), Vector(N)};
    for (Index k = 0; k < N; ++k) {
        rows.Z.row(k) = random.normal(kCount).transpose();
        rows.Phi.row(k) = rows.Z.row(k) + 0.3 * random.normal(kCount).transpose();
        rows.y[k] = rows.Z(k, 0) - 2 * rows.Z(k, 1) + 0.5 * rows.Z(k, 2) + 0.1 * random.normal();
    }
    return rows;
}

template <class Array>
void add(Array& array, const Rows& rows, Index k, double forgetting) {
    typename Array::Row z{}, phi{};
    for (Index i = 0; i < kCount; ++i) {
        z[static_cast<std::size_t>(i)] = rows.Z(k, i);
        phi[static_cast<std::size_t>(i)] = rows.Phi(k, i);
    }
    array.add(z, phi, rows.y[k], forgetting);
}

Vector theta_of(const auto& array) {
    return Vector::Map(array.theta().data(), kCount);
}

// oracle: weighted batch sums after every sample
TEST(instrument_array, is_the_batch_estimate_at_every_sample) {
    Rows rows = random_rows(60);
    for (const double forgetting : {1.0, 0.9}) {
        InstrumentArray<kCount, true> array(kCount);
        InstrumentArray<Eigen::Dynamic, true> sized(kCount);
        for (Index k = 0; k < rows.y.size(); ++k) {
            add(array, rows, k, forgetting);
            add(sized, rows, k, forgetting);
            EXPECT_EQ(array.known(), k + 1 >= kCount);
            if (k + 1 < kCount) continue;
            Vector weights(k + 1);
            for (Index i = 0; i <= k; ++i) weights[i] = std::pow(forgetting, double(k - i));
            const Matrix Z = rows.Z.topRows(k + 1), Phi = rows.Phi.topRows(k + 1);
            const Matrix inverse = (Z.transpose() * weights.asDiagonal() * Phi).inverse();
            const Vector batch = inverse * Z.transpose() * weights.asDiagonal() * rows.y.head(k + 1);
            EXPECT_LT((theta_of(array) - batch).norm(), 1e-10 * batch.norm()) << k;
            EXPECT_EQ(theta_of(array), theta_of(sized));
            const Matrix covariance = inverse * Z.transpose() * weights.asDiagonal() * Z * inverse.transpose();
            EXPECT_LT((array.inverse_gram() - covariance).norm(), 1e-9 * covariance.norm()) << k;
        }
    }
}

TEST(instrument_array, least_squares_know_their_squares) {  // oracle: residuals of the batch
    Rows rows = random_rows(60);
    rows.Z = rows.Phi;
    InstrumentArray<kCount, false> array(kCount);
    for (Index k = 0; k < rows.y.size(); ++k) add(array, rows, k, 1);
    const Vector theta = rows.Phi.householderQr().solve(rows.y);
    EXPECT_LT((theta_of(array) - theta).norm(), 1e-13);
    EXPECT_NEAR(array.variance(), (rows.y - rows.Phi * theta).squaredNorm() / 57, 1e-14);
}

// oracle: the Kalman filter as textbooks write it, from a covariance large against what is learnt
TEST(instrument_array, walking_parameters_are_a_kalman_filter) {
    Rows rows = random_rows(60);
    rows.Z = rows.Phi;
    const Vector steps{{1e-3, 0, 0.1}};
    InstrumentArray<kCount, false> array(kCount);
    Matrix P = 1e9 * Matrix::Identity(kCount, kCount);
    Vector theta = Vector::Zero(kCount);
    for (Index k = 0; k < rows.y.size(); ++k) {
        if (k > 0) {
            array.walk({1e-3, 0, 0.1});
            P += steps.asDiagonal();
        }
        add(array, rows, k, 1);
        const Vector phi = rows.Phi.row(k).transpose();
        const Vector gain = P * phi / (1 + phi.dot(P * phi));
        theta += gain * (rows.y[k] - phi.dot(theta));
        P -= gain * (P * phi).transpose();
    }
    EXPECT_LT((theta_of(array) - theta).norm(), 1e-6);
    EXPECT_LT((array.inverse_gram() - P).norm(), 1e-6 * P.norm());
}

TEST(instrument_array, nothing_is_forgotten_while_nothing_is_learnt) {  // oracle: the estimate of before
    const Rows rows = random_rows(60);
    InstrumentArray<kCount, true> array(kCount);
    for (Index k = 0; k < rows.y.size(); ++k) add(array, rows, k, 0.9);
    const Vector theta = theta_of(array);
    const Matrix covariance = array.inverse_gram();
    for (int k = 0; k < 100'000; ++k) array.add({}, {}, 0, 0.9);
    EXPECT_LT((theta_of(array) - theta).norm(), 1e-9);
    EXPECT_LT((array.inverse_gram() - covariance).norm(), 1e-9 * covariance.norm());
}

// oracle: batch sums over the samples that are not forgotten; eigenvalues
TEST(instrument_array, stays_exact_and_positive_over_ten_million_samples) {
    constexpr Index kPeriod = 1000, kSamples = 10'000'000;
    constexpr double kForgetting = 0.99;
    const Rows rows = random_rows(kPeriod);
    InstrumentArray<kCount, true> array(kCount);
    for (Index k = 0; k < kSamples; ++k) add(array, rows, k % kPeriod, kForgetting);
    Matrix z_phi = Matrix::Zero(kCount, kCount), z_z = z_phi;
    Vector z_y = Vector::Zero(kCount);
    for (Index back = 0; back < 5 * kPeriod; ++back) {
        const Index k = (kSamples - 1 - back) % kPeriod;
        const double weight = std::pow(kForgetting, double(back));
        z_phi += weight * rows.Z.row(k).transpose() * rows.Phi.row(k);
        z_z += weight * rows.Z.row(k).transpose() * rows.Z.row(k);
        z_y += weight * rows.Z.row(k).transpose() * rows.y[k];
    }
    const Matrix inverse = z_phi.inverse(), covariance = inverse * z_z * inverse.transpose();
    EXPECT_LT((theta_of(array) - inverse * z_y).norm(), 1e-11);
    EXPECT_LT((array.inverse_gram() - covariance).norm(), 1e-11 * covariance.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix>(array.inverse_gram()).eigenvalues().minCoeff(), 0);
}

}  // namespace test_instrument_array
