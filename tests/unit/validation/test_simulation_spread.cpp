#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "numerics/estimators/oe.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/simulation_spread.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_simulation_spread {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

using ModelOfParameters = std::function<TransferFunction(const Vector& theta)>;

/// Standard deviations to first order, the derivatives of the simulated output by central differences.
Vector first_order_std(const ModelOfParameters& model, const Vector& theta, const Matrix& covariance, const Vector& u,
                       double Ts) {
    Matrix derivatives(u.size(), theta.size());
    for (Index i = 0; i < theta.size(); ++i) {
        const double h = 1e-5 * std::max(1e-3, std::abs(theta[i]));
        const Vector step = h * Vector::Unit(theta.size(), i);
        derivatives.col(i) = (lsim(model(theta + step), u, Ts) - lsim(model(theta - step), u, Ts)) / (2 * h);
    }
    return (derivatives * covariance).cwiseProduct(derivatives).rowwise().sum().cwiseSqrt();
}

// Oracle: the delta method, for standard errors so small that the model is linear in them; the spread of a standard
// deviation of 2000 runs is 1.6 %.
TEST(simulation_spread, is_that_of_first_order_for_small_errors) {
    const TransferFunction G(Vector{{2.0, 8.0}}, Vector{{1.0, 1.2, 400.0}}, 0, 0.31);
    const Vector std{{0.001, 0.05, 0.0004, 0.003, 0.0005}};
    Matrix correlation = Matrix::Identity(5, 5);
    correlation(0, 2) = correlation(2, 0) = 0.9;
    correlation(1, 4) = correlation(4, 1) = -0.6;
    const Matrix covariance = std.asDiagonal() * correlation * std.asDiagonal();
    const Vector u = random_levels(300, 10, 4);
    RandomStream random(2);
    const SimulationSpread spread = simulation_spread(UncertainModel(G, covariance), u, 0.02, Hold::kZoh, 2000, random);
    const auto model = [](const Vector& theta) {
        return TransferFunction(theta.segment(2, 2), Vector{{1, theta[0], theta[1]}}, 0, theta[4]);
    };
    const Vector expected = first_order_std(model, Vector{{1.2, 400, 2, 8, 0.31}}, covariance, u, 0.02);
    EXPECT_EQ(spread.output, lsim(G, u, 0.02));
    EXPECT_EQ(spread.unstable, 0);
    EXPECT_EQ(spread.drawn.cols(), 2000);
    EXPECT_NEAR((spread.std - expected).norm() / expected.norm(), 0, 0.05);
}

TEST(simulation_spread, of_difference_equations) {  // oracle: the delta method, with the covariance of an estimate
    const PolynomialOrders orders = PolynomialOrders::output_error({2}, {2}, {1});
    const Vector theta{{-1.2, 0.5, 1, 0.4}}, u = random_levels(600, 5, 8);
    const Vector y =
        model_output(PolynomialModel(orders, theta, 0.5), u, Vector::Zero(600)) + 0.1 * RandomStream(9).normal(600);
    const Fit fit = oe(IdData(Matrix(y), Matrix(u), 0.5), orders);
    RandomStream random(2);
    const SimulationSpread spread = simulation_spread(*fit.polynomial, fit.covariance, u, 2000, random);
    const auto model = [&](const Vector& drawn) { return PolynomialModel(orders, drawn, 0.5).transfer_function(); };
    const Vector expected = first_order_std(model, fit.theta, fit.covariance, u, 0.5);
    EXPECT_NEAR((spread.std - expected).tail(550).norm() / expected.tail(550).norm(), 0, 0.05);
}

// Oracle: inputs whose parameters are independent add their variances; each alone is the spread of one input.
TEST(simulation_spread, of_several_inputs) {
    const TransferStructure both = TransferStructure::grid(1, 2, Denominators::kPerChannel, {1, 1}, {0, 0}, {0, 0});
    const TransferStructure one = TransferStructure::single(1, 0);
    const Vector theta{{2, 3, 0.5, 1}}, std{{0.02, 0.03, 0.004, 0.02}};
    const Matrix covariance = std.cwiseAbs2().asDiagonal();
    Matrix u(200, 2);
    u << random_levels(200, 10, 4), random_levels(200, 7, 5);
    RandomStream random(3);
    const auto spread = [&](const TransferStructure& structure, Index first, Index count, const Matrix& inputs) {
        return simulation_spread(structure, theta.segment(first, count), covariance.block(first, first, count, count),
                                 inputs, 0.1, Hold::kZoh, 2000, random);
    };
    const SimulationSpread all = spread(both, 0, 4, u), first = spread(one, 0, 2, u.col(0)),
                           second = spread(one, 2, 2, u.col(1));
    EXPECT_LT((all.output - first.output - second.output).norm(), 1e-12 * all.output.norm());
    const Vector expected = (first.std.cwiseAbs2() + second.std.cwiseAbs2()).cwiseSqrt();
    EXPECT_NEAR((all.std - expected).norm() / expected.norm(), 0, 0.05);
}

TEST(simulation_spread, reports_unstable_draws) {  // oracle: the share of negative normal numbers
    RandomStream random(5);
    const UncertainModel uncertain(TransferFunction(Vector{{1.0}}, Vector{{1.0, 1.0}}), Matrix{{1, 0}, {0, 0}});
    const SimulationSpread spread = simulation_spread(uncertain, Vector::Ones(20), 0.1, Hold::kZoh, 2000, random);
    EXPECT_NEAR(static_cast<double>(spread.unstable) / 2000, 0.1587, 0.025);  // P(a < 0), a ~ N(1, 1)
}

TEST(simulation_spread, refuses_what_makes_no_spread) {  // oracle: definitions
    RandomStream random;
    const UncertainModel uncertain(TransferFunction(Vector{{1.0}}, Vector{{1.0, 1.0}}), Matrix::Identity(2, 2));
    EXPECT_THAT(thrown_message([&] { simulation_spread(uncertain, Vector::Ones(9), 1, Hold::kZoh, 1, random); }),
                HasSubstr("number of runs must be at least 2"));
    EXPECT_THAT(thrown_message([&] { simulation_spread(uncertain, Vector::Ones(9), 1, Hold::kZoh, 6000000, random); }),
                HasSubstr("too large"));
    const PolynomialModel model(PolynomialOrders::arx(1, {1}, {1}), Vector{{-0.5, 1}}, 1);
    EXPECT_THAT(thrown_message([&] { simulation_spread(model, Matrix::Identity(3, 3), Vector::Ones(9), 9, random); }),
                HasSubstr("the 2 parameters, but got a 3 x 3 matrix"));
    const PolynomialModel two(PolynomialOrders::arx(1, {1, 1}, {1, 1}), Vector{{-0.5, 1, 1}}, 1);
    EXPECT_THAT(thrown_message([&] { simulation_spread(two, Matrix::Identity(3, 3), Vector::Ones(9), 9, random); }),
                HasSubstr("The model has 2 inputs, but the number of specified inputs is 1"));
}

}  // namespace test_simulation_spread
