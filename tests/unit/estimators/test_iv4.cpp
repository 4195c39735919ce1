#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "base/reader.h"
#include "numerics/estimators/arx.h"
#include "numerics/estimators/iv4.h"
#include "numerics/fit/discrete/arma_noise.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_iv4 {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const PolynomialOrders kOrders = PolynomialOrders::arx(2, {2}, {1});
const Vector kTheta{{-1.5, 0.7, 1, 0.5}};

/// White noise added to the output.
IdData simulated_data(Index N, double noise, std::uint32_t seed) {
    const Vector u = random_levels(N, 2, seed + 1000);
    const Vector x = model_output(PolynomialModel(kOrders, kTheta, 1), u, Vector::Zero(N));
    return IdData(Matrix(x + noise * RandomStream(seed).normal(N)), Matrix(u), 1);
}

/// Autoregressive noise inside the equation.
IdData colored_data(Index N, std::uint32_t seed) {
    PolynomialOrders orders = kOrders;
    orders.nd = 1;
    const Vector u = random_levels(N, 2, seed + 1000), theta{{-1.5, 0.7, 1, 0.5, -0.8}};
    const Vector y = model_output(PolynomialModel(orders, theta, 1), u, 0.5 * RandomStream(seed).normal(N));
    return IdData(Matrix(y), Matrix(u), 1);
}

/// Rows [-y(k-1) -y(k-2) u(k-1) u(k-2)] from k = first on.
Matrix regressors(const Vector& y, const Vector& u, Index first) {
    const Index N = y.size() - first;
    Matrix Phi(N, 4);
    Phi << -y.segment(first - 1, N), -y.segment(first - 2, N), u.segment(first - 1, N), u.segment(first - 2, N);
    return Phi;
}

Vector instruments(const Vector& theta, const Vector& u) {
    return model_output(PolynomialModel(kOrders, theta, 1), u, Vector::Zero(u.size()));
}

TEST(iv4, recovers_noise_free_systems) {  // oracle: the simulated system
    const auto result = iv4(simulated_data(400, 0, 1), kOrders);
    EXPECT_THAT(message_text(result.message), testing::StartsWith("Instrumental variables with "));
    EXPECT_LT((result.theta - kTheta).cwiseAbs().maxCoeff(), 1e-10) << message_text(result.full_message());
}

TEST(iv4, follows_its_four_steps) {  // oracle: the definition with everything stored
    const IdData data = simulated_data(600, 1, 2);
    const Vector y = data.experiments[0].y, u = data.experiments[0].u;
    const Matrix Phi = regressors(y, u, 2);
    const Vector target = y.tail(598);
    const Vector first = Phi.householderQr().solve(target);
    const Matrix Z1 = regressors(instruments(first, u), u, 2);
    const Vector second = (Z1.transpose() * Phi).inverse() * Z1.transpose() * target;
    const Vector L = estimate_arma({Vector(target - Phi * second)}, 0, 4, 1e-12).D;
    const auto filtered = [&](const Vector& x) { return Vector(weighted_past(L, x).tail(596)); };
    const Vector yf = filtered(y), uf = filtered(u);
    const Matrix Phif = regressors(yf, uf, 2), Z = regressors(filtered(instruments(second, u)), uf, 2);
    const Matrix inverse = (Z.transpose() * Phif).inverse();
    const Vector expected = inverse * Z.transpose() * yf.tail(594);
    const double variance = (yf.tail(594) - Phif * expected).squaredNorm() / (594 - 4);
    const Matrix covariance = variance * inverse * Z.transpose() * Z * inverse.transpose();

    const auto result = iv4(data, kOrders);
    EXPECT_LT((result.theta - expected).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((result.covariance - covariance).cwiseAbs().maxCoeff(), 1e-6 * covariance.cwiseAbs().maxCoeff());
}

TEST(iv4, colored_noise_does_not_bias_it) {  // oracle: statistics with fixed seeds
    constexpr Index kRuns = 150;
    Matrix thetas(4, kRuns), errors(4, kRuns);
    double arx_error = 0;
    for (Index run = 0; run < kRuns; ++run) {
        const IdData data = colored_data(1000, static_cast<std::uint32_t>(run + 1));
        const auto result = iv4(data, kOrders);
        thetas.col(run) = result.theta;
        errors.col(run) = result.std;
        arx_error += (arx(data, kOrders).theta[0] - kTheta[0]) / kRuns;
    }
    EXPECT_GT(std::abs(arx_error), 0.02);
    for (Index i = 0; i < 4; ++i) {
        const double mean = thetas.row(i).mean();
        const double spread = std::sqrt((thetas.row(i).array() - mean).square().sum() / (kRuns - 1));
        EXPECT_NEAR(mean, kTheta[i], 3.5 * spread / std::sqrt(double(kRuns)) + 0.1 * spread) << i;
        EXPECT_NEAR(spread / errors.row(i).mean(), 1, 0.2) << i;
    }
}

TEST(iv4, refuses_what_it_cannot_fit) {  // oracle: definitions
    PolynomialOrders other = kOrders;
    other.nc = 1;
    EXPECT_THAT(thrown_message([&] { iv4(simulated_data(100, 0.1, 1), other); }), HasSubstr("nd and nf must be zero"));
    EXPECT_THAT(thrown_message([&] { iv4(simulated_data(6, 0.1, 1), kOrders); }),
                HasSubstr("iv4 estimates 4 parameters and needs more equations than parameters"));
    EXPECT_NE(thrown_message([&] { iv4(simulated_data(8, 0.1, 1), kOrders); }), "");
}

}  // namespace test_iv4
