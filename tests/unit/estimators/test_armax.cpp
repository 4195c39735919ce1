#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/estimators/armax.h"
#include "numerics/estimators/arx.h"
#include "numerics/fit/assessment.h"
#include "numerics/fit/discrete/prediction_model.h"
#include "numerics/fit/output_error.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_armax {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

PolynomialOrders orders_of(int na, std::vector<int> nb, int nc, std::vector<int> nk) {
    PolynomialOrders orders = PolynomialOrders::arx(na, std::move(nb), std::move(nk));
    orders.nc = nc;
    return orders;
}

const PolynomialOrders kOrders = orders_of(2, {2}, 2, {1});
const Vector kTheta{{-1.5, 0.7, 1, 0.5, -1, 0.3}};

IdData simulated_data(Index N, double noise, std::uint32_t seed) {
    const Vector u = random_levels(N + 100, 2, seed + 1000), e = noise * RandomStream(seed).normal(N + 100);
    const Vector y = model_output(PolynomialModel(kOrders, kTheta, 1), u, e);
    return IdData(Matrix(y.tail(N)), Matrix(u.tail(N)), 1);
}

FitOptions tight() {
    FitOptions options;
    options.tolerance = 1e-10;
    options.max_iterations = 200;
    return options;
}

/// Mean square of e by the definition, sample by sample.
double loss_of(const IdData& data, const Vector& theta) {
    const PolynomialModel model(kOrders, theta, 1);
    const Vector y = data.experiments[0].y, u = data.experiments[0].u;
    Vector e = Vector::Zero(y.size());
    for (Index k = 2; k < y.size(); ++k) {
        e[k] = y[k];
        for (Index i = 1; i <= 2; ++i) e[k] += model.A[i] * y[k - i] - model.B[0][i] * u[k - i] - model.C[i] * e[k - i];
    }
    return e.squaredNorm() / static_cast<double>(y.size() - 2);
}

TEST(armax, recovers_noise_free_systems) {  // oracle: the simulated system
    const auto result = armax(simulated_data(500, 0, 1), kOrders, tight());
    EXPECT_LT((result.theta - kTheta).head(4).cwiseAbs().maxCoeff(), 1e-9) << message_text(result.full_message());
    EXPECT_GT(result.fit_percent[0], 100 - 1e-6);
}

TEST(armax, without_c_it_is_arx) {  // oracle: the linear solution
    const IdData data = IdData::merge({simulated_data(500, 0.5, 1), simulated_data(300, 0.5, 2)});
    const auto linear = arx(data, PolynomialOrders::arx(2, {2}, {1}));
    const auto result = armax(data, orders_of(2, {2}, 0, {1}), tight());
    EXPECT_LT((result.theta - linear.theta).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((result.std - linear.std).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(result.loss, linear.loss, 1e-10);
    EXPECT_NEAR(result.fit_percent[0], linear.fit_percent[0], 1e-7);
    EXPECT_NEAR(result.prediction_fit_percent, linear.prediction_fit_percent, 1e-7);
}

TEST(armax, gradient_is_zero_at_the_optimum) {  // oracle: central differences of the definition's loss
    const IdData data = simulated_data(800, 0.5, 3);
    const auto result = armax(data, kOrders, tight());
    EXPECT_NEAR(result.loss, loss_of(data, result.theta), 1e-10);
    for (Index i = 0; i < kTheta.size(); ++i) {
        const Vector step = 1e-4 * Vector::Unit(kTheta.size(), i);
        const double slope = (loss_of(data, result.theta + step) - loss_of(data, result.theta - step)) / 2e-4;
        EXPECT_LT(std::abs(slope), 1e-5 * result.loss) << i;
        EXPECT_GT(loss_of(data, result.theta + step), result.loss);
    }
    EXPECT_EQ(result.termination, Termination::kConverged) << message_text(result.full_message());
}

// Oracle: statistics with fixed seeds; the covariance of the maximum-likelihood estimate is the Cramer-Rao bound.
TEST(armax, scatters_as_its_standard_errors_say) {
    constexpr Index kRuns = 150;
    Matrix thetas(6, kRuns), errors(6, kRuns);
    for (Index run = 0; run < kRuns; ++run) {
        const auto result = armax(simulated_data(800, 0.5, static_cast<std::uint32_t>(run + 1)), kOrders);
        thetas.col(run) = result.theta;
        errors.col(run) = result.std;
    }
    for (Index i = 0; i < 6; ++i) {
        const double mean = thetas.row(i).mean();
        const double spread = std::sqrt((thetas.row(i).array() - mean).square().sum() / (kRuns - 1));
        EXPECT_NEAR(spread / errors.row(i).mean(), 1, 0.2) << i;
        EXPECT_NEAR(mean, kTheta[i], 3.5 * spread / std::sqrt(double(kRuns)) + 0.1 * spread) << i;
    }
}

TEST(armax, two_inputs_and_a_delay) {  // oracle: the simulated system
    const PolynomialOrders orders = orders_of(1, {1, 2}, 1, {1, 3});
    const Vector theta{{-0.8, 1, -2, 0.5, 0.6}};
    Matrix u(2000, 2);
    u << random_levels(2000, 2, 1), random_levels(2000, 3, 2);
    const Vector y = model_output(PolynomialModel(orders, theta, 1), u, 0.1 * RandomStream(3).normal(2000));
    const auto result = armax(IdData(Matrix(y), u, 1), orders);
    for (Index i = 0; i < theta.size(); ++i) EXPECT_NEAR(result.theta[i], theta[i], 4 * result.std[i]) << i;
    EXPECT_EQ(result.names, (std::vector<std::string>{"a1", "b1_u1", "b3_u2", "b4_u2", "c1"}));
}

TEST(armax, prediction_errors_are_tested_for_whiteness) {  // oracle: statistics with a fixed seed
    const IdData data = simulated_data(2000, 0.5, 5);
    const auto right = assess(data, armax(data, kOrders));
    EXPECT_TRUE(right.white) << message_text(right.verdict);
    const auto right_fit = armax(data, kOrders);
    for (Index i = 0; i < 6; ++i) EXPECT_NEAR(right.std[i] / right_fit.std[i], 1, 0.3);
    const auto poor = assess(data, armax(data, orders_of(2, {2}, 0, {1})));
    EXPECT_FALSE(poor.white);
}

TEST(armax, can_be_canceled) {  // oracle: definition
    FitOptions options;
    options.cancel = [] { return true; };
    EXPECT_EQ(armax(simulated_data(300, 0.5, 1), kOrders, options).termination, Termination::kCanceled);
}

TEST(armax, refuses_what_it_cannot_fit) {  // oracle: definitions
    const auto refusal = [](const IdData& data, const PolynomialOrders& orders) {
        return thrown_message([&] { armax(data, orders); });
    };
    PolynomialOrders other = kOrders;
    other.nd = 1;
    EXPECT_THAT(refusal(simulated_data(100, 0.1, 1), other), HasSubstr("nd and nf must be zero"));
    EXPECT_THAT(refusal(simulated_data(6, 0.1, 1), kOrders),
                HasSubstr("armax estimates 4 parameters and needs more equations than parameters"));
    IdData constant = simulated_data(100, 0.1, 1);
    constant.experiments[0].u.setOnes();
    EXPECT_THAT(refusal(constant, kOrders), HasSubstr("armax: the input u1 is not persistently exciting of order nb"));
}

/// Oracle: the search over all samples from the truth. The first quarter of the second data set shows next to nothing.
TEST(armax, long_records_end_where_the_search_from_the_truth_ends) {
    constexpr Index kLong = 420000;
    Vector u = random_levels(kLong, 2, 7);
    for (const Index quiet : {Index{0}, kLong / 4}) {
        u.head(quiet).setZero();
        const Vector e = 0.5 * RandomStream(3).normal(kLong);
        const IdData data(Matrix(model_output(PolynomialModel(kOrders, kTheta, 1), u, e)), Matrix(u), 1);
        const Fit found = armax(data, kOrders, tight());
        const std::vector<SampledExperiment> experiments{{data.experiments[0].u, data.experiments[0].y.col(0)}};
        const PredictionModel model(kOrders, {InitialState::kEstimate, false}, experiments);
        const Fit best = minimize_output_error(model, model.target(), kTheta, FitOptions{}.limited(200, 1e-10));
        EXPECT_LT((found.theta - best.theta).cwiseAbs().maxCoeff(), 1e-7);
        EXPECT_LT((found.theta - kTheta).cwiseQuotient(found.std).cwiseAbs().maxCoeff(), 4.5);
    }
}

TEST(armax, zeros_of_the_noise_near_the_unit_circle_have_no_standard_error) {  // oracle: the zeros put in
    for (const double zero : {0.98, 0.5}) {
        PolynomialOrders orders = orders_of(1, {1}, 1, {1});
        const Vector u = random_levels(610, 2, 7), e = 0.3 * RandomStream(9).normal(610);
        const Vector y = model_output(PolynomialModel(orders, Vector{{-0.8, 1.0, -zero}}, 1), u, e);
        const Fit found = armax(IdData(Matrix(y.tail(510)), Matrix(u.tail(510)), 1), orders, {});
        EXPECT_EQ(std::isinf(found.std[2]), zero > 0.9) << found.std.transpose();
        EXPECT_TRUE(std::isfinite(found.std[0]) && std::isfinite(found.std[1])) << found.std.transpose();
    }
}

}  // namespace test_armax
