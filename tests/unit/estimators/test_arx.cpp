#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Dense>

#include "base/reader.h"
#include "numerics/estimators/arx.h"
#include "numerics/models/convert.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_arx {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const PolynomialOrders kSecond = PolynomialOrders::arx(2, {2}, {2});
const Vector kTruth{{-1.2, 0.5, 0.4, -0.1}};

IdData simulated_data(Index N, double noise, std::uint32_t seed, double Ts = 0.1) {
    const Vector u = random_levels(N, 3, seed + 100);
    const Vector e = noise * RandomStream(seed).normal(N);
    return IdData(Matrix(model_output(PolynomialModel(kSecond, kTruth, Ts), u, e)), Matrix(u), Ts);
}

/// Phi and y written down from the definition, for one experiment.
struct Equations {
    Matrix Phi;
    Vector y;
};
Equations equations(const Matrix& u, const Vector& y, const PolynomialOrders& orders) {
    const Index past = orders.past(), rows = y.size() - past;
    Equations result{Matrix(rows, orders.parameter_count()), y.tail(rows)};
    for (Index r = 0; r < rows; ++r) {
        Index column = 0;
        const Index k = past + r;
        for (int i = 1; i <= orders.na; ++i) result.Phi(r, column++) = -y[k - i];
        for (std::size_t input = 0; input < orders.inputs(); ++input)
            for (int j = 0; j < orders.nb[input]; ++j)
                result.Phi(r, column++) = u(k - orders.nk[input] - j, static_cast<Index>(input));
    }
    return result;
}

double worst(const Vector& a, const Vector& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

TEST(arx, recovers_a_noise_free_system) {  // oracle: the simulated system
    for (double Ts : {0.1, 1e-6}) {
        const auto result = arx(simulated_data(400, 0, 1, Ts), kSecond);
        EXPECT_LT(worst(result.theta, kTruth), 1e-12);
        EXPECT_GT(result.fit_percent[0], 100 - 1e-9);
        EXPECT_EQ(result.polynomial->Ts, Ts);
        EXPECT_EQ(result.polynomial->B[0], (Vector{{0, 0, result.theta[2], result.theta[3]}}));
    }
}

TEST(arx, solves_the_normal_equations) {               // oracle: the definition, orthogonality of the residuals
    const IdData data = simulated_data(5000, 0.3, 2);  // several blocks
    const auto result = arx(data, kSecond);
    const auto [Phi, y] = equations(data.experiments[0].u, data.experiments[0].y, kSecond);
    const Vector residuals = y - Phi * result.theta;
    EXPECT_LT((Phi.transpose() * residuals).norm(), 1e-10 * Phi.norm() * residuals.norm());
    EXPECT_NEAR(result.loss, residuals.squaredNorm() / 4997, 1e-12);
    EXPECT_NEAR(result.noise_variance[0], residuals.squaredNorm() / (4997 - 4), 1e-12);
    const Matrix covariance = result.noise_variance[0] * (Phi.transpose() * Phi).inverse();
    EXPECT_LT((result.covariance - covariance).norm(), 1e-9 * covariance.norm());
    EXPECT_LT(worst(result.std, covariance.diagonal().cwiseSqrt()), 1e-10);
}

TEST(arx, several_inputs_and_experiments) {  // oracle: second route, orthogonal factors of all equations together
    const PolynomialOrders orders = PolynomialOrders::arx(1, {2, 1}, {0, 3});
    const PolynomialModel truth(orders, Vector{{-0.8, 1, 0.5, -2}}, 1);
    std::vector<IdData> parts;
    Matrix Phi(0, 4);
    Vector y(0);
    for (std::uint32_t seed : {1u, 2u, 3u}) {
        const Index N = 60 + 20 * static_cast<Index>(seed);
        Matrix u(N, 2);
        u << random_levels(N, 2, seed), random_levels(N, 3, seed + 10);
        parts.push_back(IdData(Matrix(model_output(truth, u, 0.2 * RandomStream(seed).normal(N))), u, 1));
        const auto more = equations(u, parts.back().experiments[0].y, orders);
        Phi.conservativeResize(Phi.rows() + more.Phi.rows(), 4);
        Phi.bottomRows(more.Phi.rows()) = more.Phi;
        y.conservativeResize(y.size() + more.y.size());
        y.tail(more.y.size()) = more.y;
    }
    const auto result = arx(IdData::merge(parts), orders);
    EXPECT_LT(worst(result.theta, Phi.colPivHouseholderQr().solve(y)), 1e-12);
    const auto reversed = arx(IdData::merge({parts[2], parts[0], parts[1]}), orders);
    EXPECT_LT(worst(result.theta, reversed.theta), 1e-13);
    EXPECT_LT((result.covariance - reversed.covariance).norm(), 1e-12 * result.covariance.norm());
    EXPECT_NEAR(result.fit_percent[0], reversed.fit_percent[0], 1e-10);
}

TEST(arx, nearly_dependent_regressors_go_the_orthogonal_way) {  // oracle: the simulated system
    // Fast sampling: successive outputs are almost equal, and the Gram matrix would lose eight digits of the truth.
    const TransferFunction G = c2d(TransferFunction(Vector{{2}}, Vector{{1, 4, 3}}), 1e-4);
    Vector truth(4);
    truth << G.den().tail(2), G.num();
    const PolynomialOrders orders = PolynomialOrders::arx(2, {2}, {1});
    const Vector u = random_levels(20000, 500, 3);
    const Vector y = model_output(PolynomialModel(orders, truth, 1e-4), u, Vector::Zero(20000));
    const auto result = arx(IdData(Matrix(y), Matrix(u), 1e-4), orders);
    EXPECT_GT(result.condition_number, 1e3);
    EXPECT_LT(worst(result.theta, truth), 1e-10);
    const TransferFunction back = d2c(result.polynomial->transfer_function());
    EXPECT_NEAR(back.den()[1], 4, 1e-3);
    EXPECT_NEAR(back.den()[2], 3, 1e-3);
}

TEST(arx,
     the_orthogonal_way_uses_every_equation) {  // oracle: second route, orthogonal factors of all equations together
    const Vector u = 1e5 + random_levels(3000, 3, 1).array(), e = 0.3 * RandomStream(2).normal(3000);
    const Vector y = model_output(PolynomialModel(kSecond, kTruth, 1), u, e);
    const auto result = arx(IdData(Matrix(y), Matrix(u), 1), kSecond);
    EXPECT_GT(result.condition_number, 1e3);
    const auto [Phi, right] = equations(u, y, kSecond);
    EXPECT_LT(worst(result.theta, Phi.colPivHouseholderQr().solve(right)), 1e-9);
    EXPECT_NEAR(result.noise_variance[0], (right - Phi * result.theta).squaredNorm() / (2997 - 4), 1e-9);
}

TEST(arx, too_high_orders_are_reported) {  // oracle: the simulated system; the past takes five of 400 samples
    const auto result = arx(simulated_data(400, 0, 1), PolynomialOrders::arx(4, {4}, {2}));
    EXPECT_THAT(message_text(result.message), HasSubstr("Least squares with 395 equations: fit "));
    EXPECT_THAT(message_text(result.full_message()), HasSubstr("do not determine all parameters separately"));
    EXPECT_GT(result.fit_percent[0], 100 - 1e-5);
}

TEST(arx, doubtful_results_come_with_a_sentence) {  // oracle: the simulated system
    const Vector u = random_levels(300, 3, 1), e = RandomStream(4).normal(300);
    EXPECT_THAT(message_text(arx(IdData(Matrix(e), Matrix(u), 1), kSecond).full_message()),
                HasSubstr("do not reliably determine"));
    const PolynomialOrders first = PolynomialOrders::arx(1, {1}, {1});
    const Vector y = model_output(PolynomialModel(first, Vector{{-1.05, 1}}, 1), u, e);
    EXPECT_THAT(message_text(arx(IdData(Matrix(y), Matrix(u), 1), first).full_message()), HasSubstr("unstable"));
}

TEST(arx, refuses_poor_inputs_and_is_right) {
    const Vector e = RandomStream(4).normal(200), constant = Vector::Ones(200), zero = Vector::Zero(200);
    const Vector sine = (0.3 * Vector::LinSpaced(200, 0, 199).array()).sin();
    const auto refusal = [&](const Vector& u, const PolynomialOrders& orders) {
        return thrown_message([&] { arx(IdData(Matrix(e), Matrix(u), 1), orders); });
    };
    EXPECT_THAT(refusal(zero, kSecond), HasSubstr("u1 is zero in all samples"));
    EXPECT_THAT(refusal(constant, kSecond), HasSubstr("not persistently exciting of order nb = 2"));
    EXPECT_EQ(refusal(constant, PolynomialOrders::arx(1, {1}, {1})), "");
    EXPECT_THAT(refusal(sine, PolynomialOrders::arx(1, {3}, {1})),
                HasSubstr("not persistently exciting of order nb = 3"));
    EXPECT_EQ(refusal(sine, PolynomialOrders::arx(1, {2}, {1})), "");
    // Justified: other coefficients explain the same data equally well.
    const auto [Phi, y] = equations(sine, e, PolynomialOrders::arx(1, {3}, {1}));
    const Vector alternative{{0, 1, -2 * std::cos(0.3), 1}};
    EXPECT_LT((Phi * alternative).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(arx, refuses_other_data_and_orders) {
    const IdData data = simulated_data(100, 0.1, 1);
    const Vector u = data.experiments[0].u, y = data.experiments[0].y;
    const auto refusal = [](const IdData& given, const PolynomialOrders& orders) {
        return thrown_message([&] { arx(given, orders); });
    };
    EXPECT_THAT(refusal(IdData(Matrix::Random(100, 2), Matrix(u), 1), kSecond), HasSubstr("needs one output"));
    EXPECT_THAT(refusal(IdData(Matrix(y), Matrix::Random(100, 2), 1), kSecond), HasSubstr("2 inputs"));
    EXPECT_THAT(refusal(IdData(Matrix(y), Matrix(100, 0), 1), kSecond), HasSubstr("needs an input"));
    EXPECT_THAT(refusal(IdData(Matrix(y), Matrix(u), Vector::LinSpaced(100, 0, 1)), kSecond), HasSubstr("regularly"));
    EXPECT_THAT(refusal(IdData(Matrix::Ones(100, 1), Matrix(u), 1), kSecond), HasSubstr("never changes"));
    const IdData rich(Matrix(RandomStream(1).normal(8)), Matrix(RandomStream(2).normal(8)), 1);
    EXPECT_THAT(refusal(rich.range(1, 7), kSecond),
                HasSubstr("estimates 4 parameters and needs more equations than parameters"));
    EXPECT_EQ(refusal(rich, kSecond), "");
    EXPECT_THAT(refusal(data, PolynomialOrders::output_error({1}, {1}, {1})), HasSubstr("nf must be zero"));
}

TEST(arx, an_operating_point_is_named) {  // oracle: a heater of gain 0.6 from 23 degrees, and without
    const Vector u = 50 + 10 * random_levels(600, 20, 3).array(), noise = 0.1 * RandomStream(5).normal(600);
    const double a = std::exp(-1.0 / 30);
    for (const double level : {23.0, 0.0}) {
        Vector y(600);
        double x = 0.6 * 50;
        for (Index k = 0; k < 600; ++k) {
            y[k] = level + x + noise[k];
            x = a * x + (1 - a) * 0.6 * u[k];
        }
        const std::string message =
            message_text(arx(IdData(Matrix(y), Matrix(u), 1), PolynomialOrders::arx(2, {2}, {1})).full_message());
        EXPECT_EQ(message.find("Remove the means") != std::string::npos, level > 0) << message;
    }
}

}  // namespace test_arx
