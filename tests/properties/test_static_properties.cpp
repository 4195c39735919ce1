#include <gtest/gtest.h>

#include <cmath>

#include "numerics/estimators/gradient_descent.h"
#include "numerics/estimators/linear_regression.h"
#include "numerics/estimators/step_test.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/transfer_cases.h"

namespace test_static_properties {

using namespace dynlab;
using namespace dynlab::test;

using Reading = StepTestResult (*)(const IdData&);

struct StepCase {
    const char* name;
    Reading read;
    TransferFunction G;
    std::vector<double> powers;  // of time in each parameter
};

const std::vector<StepCase> kReadings = {
    {"step_first_order", step_first_order, TransferFunction(values({2}), values({0.5, 1})), {0, 1}},
    {"step_second_order", step_second_order, TransferFunction(values({18}), values({1, 3, 9})), {0, 0, -1}},
    {"step_delayed", step_delayed, TransferFunction(values({2}), values({0.5, 1}), 0, 0.3), {0, 1, 1}},
};

struct Step {
    Matrix u, y;
};

Step step_of(const TransferFunction& G) {
    Vector u = Vector::Zero(900);
    u.tail(800).setOnes();
    const Vector y = lsim(G, u, 0.01);
    return {u, y + 0.005 * RandomStream(3).normal(900)};
}

class step_properties : public testing::TestWithParam<std::size_t> {
  protected:
    Vector read(const IdData& data) const { return kReadings[GetParam()].read(data).parameters; }
    const Step step_ = step_of(kReadings[GetParam()].G);
};

TEST_P(step_properties, units_scale_gain_and_times) {  // oracle: invariance
    const Vector one = read(IdData(step_.y, step_.u, 0.01));
    Vector gain = Vector::Ones(one.size());
    for (const auto& [of_y, of_u] : {std::pair{1e4, 1e-3}, std::pair{-1e-6, 1e6}}) {
        gain[0] = of_y / of_u;
        EXPECT_LT(relative_difference(read(IdData(of_y * step_.y, of_u * step_.u, 0.01)), one.cwiseProduct(gain)),
                  1e-9);
    }
    for (const double scale : {1e-6, 3600.0}) {
        Vector expected = one;
        for (Index i = 0; i < one.size(); ++i)
            expected[i] *= std::pow(scale, kReadings[GetParam()].powers[static_cast<std::size_t>(i)]);
        EXPECT_LT(relative_difference(read(IdData(step_.y, step_.u, 0.01 * scale)), expected), 1e-8) << scale;
    }
}

TEST_P(step_properties, levels_before_the_step_do_not_matter) {  // oracle: invariance
    const Vector one = read(IdData(step_.y, step_.u, 0.01));
    const Matrix lifted_y = step_.y.array() + 40, lifted_u = step_.u.array() - 7;
    EXPECT_LT(relative_difference(read(IdData(lifted_y, lifted_u, 0.01)), one), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(readings, step_properties, testing::Range<std::size_t>(0, kReadings.size()),
                         [](const auto& instance) { return std::string(kReadings[instance.param].name); });

class regression_properties : public testing::Test {
  protected:
    const Matrix Phi_ = RandomStream(1).normal(300).reshaped(100, 3);
    const Vector y_ = Phi_ * values({1, -2, 0.5}) + 0.1 * RandomStream(2).normal(100);
};

TEST_F(regression_properties, order_of_rows_does_not_matter) {  // oracle: invariance
    const Matrix turned = Phi_.colwise().reverse();
    const Vector back = y_.reverse();
    EXPECT_LT(relative_difference(lsq(turned, back).theta, lsq(Phi_, y_).theta), 1e-12);
    EXPECT_LT(relative_difference(gradient_descent(turned, back).theta, gradient_descent(Phi_, y_).theta), 1e-8);
}

TEST_F(regression_properties, units_scale_the_parameters) {  // oracle: invariance
    const Vector units = values({1e6, 1e-4, -3});
    const LinearRegression one = lsq(Phi_, y_), other = lsq(Phi_ * units.asDiagonal(), 1e3 * y_);
    const Vector factor = 1e3 * units.cwiseInverse();
    EXPECT_LT(relative_difference(other.theta, one.theta.cwiseProduct(factor)), 1e-12);
    EXPECT_LT(relative_difference(other.std, one.std.cwiseProduct(factor.cwiseAbs())), 1e-10);
    // Steepest descent sees the shape of the valley, so that all regressors must change alike.
    const Vector path = gradient_descent(Phi_, y_).theta, steep = gradient_descent(1e5 * Phi_, -1e2 * y_).theta;
    EXPECT_LT(relative_difference(steep, -1e-3 * path), 1e-8);
}

TEST_F(regression_properties, polynomials_may_begin_at_any_abscissa) {  // oracle: invariance
    const Vector x = Vector::LinSpaced(100, 0, 3);
    const PolynomialFit one = fit_polynomial(x, y_, 2), late = fit_polynomial(x.array() + 2000, y_, 2);
    const auto value = [](const PolynomialFit& fit, double at) {
        return evaluate(fit.regression.theta, at - fit.center);
    };
    EXPECT_NEAR(value(late, 2001.7), value(one, 1.7), 1e-9);
    EXPECT_LT(relative_difference(late.regression.theta, one.regression.theta), 1e-8);
}

}  // namespace test_static_properties
