#include <gtest/gtest.h>

#include <cmath>

#include "numerics/criteria/reparametrized.h"

namespace test_reparametrized {

using namespace dynlab;

/// y(k) = q_0 exp(-q_1 k/3000), k counted in rows.
class Decay : public OutputErrorModel {
  public:
    Decay() { set_free(2); }
    void simulate(const Vector& q, Vector& output, Matrix* sensitivities) const override {
        const Vector k = Vector::LinSpaced(kRows, 0, 1);
        const Vector shape = (-q[1] * k).array().exp();
        output = q[0] * shape;
        if (sensitivities == nullptr) return;
        sensitivities->resize(kRows, 2);
        *sensitivities << shape, -(k.array() * output.array()).matrix();
    }
    static constexpr Index kRows = 3001;  // several blocks of rows
};

/// q = [theta_0 theta_1, exp(theta_1)].
Reparametrized::Point product_and_exponential(const Vector& theta) {
    Matrix derivatives(2, 2);
    derivatives << theta[1], theta[0], 0, std::exp(theta[1]);
    return {Vector{{theta[0] * theta[1], std::exp(theta[1])}}, derivatives};
}

TEST(reparametrized, output_and_sensitivities) {  // oracle: the formula in theta, central differences
    const Decay inner;
    const Vector bounds{{1.0, 2.0}}, theta{{2.0, 0.3}};
    const Reparametrized model(inner, product_and_exponential, -bounds, bounds);
    Vector output, plain, plus, minus;
    Matrix sensitivities;
    model.simulate(theta, output, &sensitivities);
    model.simulate(theta, plain, nullptr);
    EXPECT_EQ(output, plain);
    for (const Index k : {0, 1, 1500, 3000})
        EXPECT_NEAR(output[k], 0.6 * std::exp(-std::exp(0.3) * static_cast<double>(k) / 3000), 1e-14);
    ASSERT_EQ(sensitivities.rows(), Decay::kRows);
    for (Index i = 0; i < 2; ++i) {
        const Vector h = 1e-6 * Vector::Unit(2, i);
        model.simulate(theta + h, plus, nullptr);
        model.simulate(theta - h, minus, nullptr);
        EXPECT_LT((sensitivities.col(i) - (plus - minus) / 2e-6).cwiseAbs().maxCoeff(), 1e-8);
    }
    const Vector y = output.array() + 0.1;
    const OutputErrorProducts sums = model.products(theta, y);
    EXPECT_NEAR(sums.squares, 0.01 * Decay::kRows, 1e-10);
    EXPECT_LT((sums.gram - sensitivities.transpose() * sensitivities).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((sums.descent - sensitivities.transpose() * (y - output)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(model.parameter_count(), 2);
    EXPECT_EQ(model.lower(), -bounds);
    EXPECT_EQ(model.upper(), bounds);
}

}  // namespace test_reparametrized
