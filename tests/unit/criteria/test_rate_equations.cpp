#include "numerics/criteria/rate_equations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/thrown_message.h"

namespace test_rate_equations {

using namespace dynlab;
using testing::HasSubstr;

/// Columns f(t) and the same as input.
template <class F>
IdData sampled(const Vector& t, F f) {
    Vector x(t.size());
    for (Index k = 0; k < t.size(); ++k) x[k] = f(t[k]);
    return IdData(Matrix(x), Matrix(t.size(), 0), t);
}

FunctionLibrary states_alone() {
    return {{"x"}, [](const Matrix& X, const Matrix&) { return X; }};
}

TEST(rate_equations, derivatives_of_polynomials_are_exact) {  // oracle: the derivative of t^4 - 2 t
    Vector t(12);
    for (Index k = 0; k < 12; ++k) t[k] = 0.1 * static_cast<double>(k) + 0.02 * std::sin(static_cast<double>(5 * k));
    const IdData data = sampled(t, [](double s) { return s * s * s * s - 2 * s; });
    for (const int window : {5, 9}) {
        const RateEquations equations = derivative_equations(data, 0, states_alone(), window);
        ASSERT_EQ(equations.B.rows(), 12);
        for (Index k = 0; k < 12; ++k) {
            EXPECT_NEAR(equations.B(k, 0), 4 * std::pow(t[k], 3) - 2, 1e-10) << k;
            EXPECT_NEAR(equations.Theta(k, 0), data.experiments[0].y(k, 0), 1e-12) << k;
        }
    }
}

TEST(rate_equations, leave_out_samples_beside_a_jump) {  // oracle: which windows of 5 hold a jump, by hand
    Matrix u = Matrix::Zero(30, 1), y(30, 1);
    u.bottomRows(15).setOnes();
    for (Index k = 0; k < 30; ++k) y(k, 0) = std::exp(-0.1 * static_cast<double>(k));
    const IdData data(y, u, 1);
    // windows first..first + 4 read the inputs of four intervals: one of first + 1..first + 3 being 15 is a jump
    EXPECT_EQ(derivative_equations(data, 0, states_alone(), 5).B.rows(), 30 - 3);
}

TEST(rate_equations, weak_ones_hold_for_an_exponential) {  // oracle: dx/dt = -2 x, so Theta xi = B with xi = -2
    const Vector t = Vector::LinSpaced(401, 0, 4);
    const IdData data = sampled(t, [](double s) { return std::exp(-2 * s); });
    const RateEquations equations = weak_equations(data, 0, states_alone(), 0.5);
    ASSERT_GT(equations.B.rows(), 50);
    EXPECT_LT((equations.Theta * -2 - equations.B).cwiseAbs().maxCoeff() / equations.B.cwiseAbs().maxCoeff(), 1e-10);
}

TEST(rate_equations, weak_ones_know_that_inputs_are_held) {  // oracle: dx/dt = u exactly, x interpolated
    const Index N = 200;
    Matrix u(N, 1), x(N, 1);
    x(0, 0) = 0;
    for (Index k = 0; k < N; ++k) u(k, 0) = static_cast<double>((7 * (k / 5)) % 11) - 5;
    for (Index k = 1; k < N; ++k) x(k, 0) = x(k - 1, 0) + 0.1 * u(k - 1, 0);
    const FunctionLibrary inputs{{"u"}, [](const Matrix&, const Matrix& U) { return U; }};
    IdData data(x, u, 0.1);
    const auto error = [&] {
        const RateEquations equations = weak_equations(data, 0, inputs, 1.5);
        return (equations.Theta - equations.B).norm() / equations.B.norm();
    };
    const double held = error();
    EXPECT_LT(held, 0.02);
    data.hold = Hold::kFoh;
    EXPECT_GT(error(), 5 * held);
}

TEST(rate_equations, refuse_what_leaves_no_room) {
    const IdData data = sampled(Vector::LinSpaced(4, 0, 3), [](double s) { return s; });
    EXPECT_THAT(thrown_message([&] { derivative_equations(data, 0, states_alone(), 5); }),
                HasSubstr("each derivative needs 5 samples, but an experiment has only 4"));
    EXPECT_THAT(thrown_message([&] { weak_equations(data, 0, states_alone(), 0.4); }),
                HasSubstr("fewer than 3 samples"));
}

TEST(rate_equations, usual_width_follows_the_oscillation) {  // oracle: cos falls to a half after a sixth of its period
    for (const double period : {2.0, 6.0}) {
        const IdData data =
            sampled(Vector::LinSpaced(3001, 0, 30), [&](double s) { return std::sin(2 * M_PI * s / period); });
        EXPECT_NEAR(usual_width(data), period / 6, 0.1 * period / 6 + 0.02);
    }
}

}  // namespace test_rate_equations
