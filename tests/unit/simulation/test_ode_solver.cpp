#include "numerics/simulation/ode_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"

namespace test_ode_solver {

using namespace dynlab;

/// y'' = -y with y(0) = 0, y'(0) = 1.
OdeState oscillator(double, const OdeState& x) {
    return OdeState{{x[1], -x[0]}};
}

/// dy/dt = t^3 - y^2, a rate that depends on both.
OdeState riccati(double t, const OdeState& x) {
    return OdeState{{t * t * t - x[0] * x[0]}};
}

/// Distance from (sin, cos) after steps of equal length to t = 10.
double error_of_steps(int count) {
    const OdeSolver solver(oscillator);
    OdeState x{{0.0, 1.0}};
    for (int k = 0; k < count; ++k) x = solver.step(10.0 * k / count, x, 10.0 / count).x;
    return std::hypot(x[0] - std::sin(10), x[1] - std::cos(10));
}

TEST(ode_solver, is_of_order_five) {  // oracle: the error of a method of order 5 shrinks by 32 when steps are halved
    EXPECT_NEAR(std::log2(error_of_steps(50) / error_of_steps(100)), 5, 0.1);
}

TEST(ode_solver, estimates_an_error_of_order_four) {  // oracle: the local error of the pair is of order h^5
    const OdeSolver solver(riccati);
    const OdeState start{{1.0}};
    const double coarse = std::abs(solver.step(0, start, 0.1).error[0]);
    const double fine = std::abs(solver.step(0, start, 0.05).error[0]);
    EXPECT_NEAR(std::log2(coarse / fine), 5, 0.3);
}

TEST(ode_solver, meets_its_tolerance) {  // oracle: analytic
    for (double tolerance : {1e-6, 1e-9, 1e-11}) {
        OdeSolver solver(oscillator, {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
        OdeState x{{0.0, 1.0}};
        double t = 0;
        EXPECT_FALSE(solver.advance(t, x, 10));
        EXPECT_EQ(t, 10);
        EXPECT_NEAR(x[0], std::sin(10), 100 * tolerance);
        EXPECT_NEAR(x[1], std::cos(10), 100 * tolerance);
    }
}

TEST(ode_solver, stops_at_events) {  // oracle: analytic, sin t turns negative at pi
    OdeSolver solver(oscillator, {.first_step = 0.5});
    OdeState x{{0.0, 1.0}};
    double t = 0;
    const OdeGuard positive = [](double, const OdeState& s) { return OdeState{{s[0], 5.0}}; };
    EXPECT_TRUE(solver.advance(t, x, 10, positive));
    EXPECT_NEAR(t, M_PI, 1e-9);
    EXPECT_LT(x[0], 0);
    EXPECT_GT(x[0], -1e-14);
}

TEST(ode_solver, bounces_a_ball) {  // oracle: analytic, k-th contact of a ball that keeps its speed
    constexpr double g = 9.81, height = 1;
    OdeSolver solver([](double, const OdeState& x) { return OdeState{{x[1], -g}}; });
    OdeState x{{height, 0.0}};
    double t = 0;
    const OdeGuard above = [](double, const OdeState& s) { return OdeState{{s[0]}}; };
    const double fall = std::sqrt(2 * height / g);
    for (int contact = 0; contact < 5; ++contact) {
        ASSERT_TRUE(solver.advance(t, x, 100, above));
        EXPECT_NEAR(t, (2 * contact + 1) * fall, 1e-9);
        x[0] = 0;
        x[1] = -x[1];
    }
}

TEST(ode_solver, gives_up_in_words_where_nothing_can_be_integrated) {
    OdeSolver solver([](double, const OdeState& x) { return OdeState{{x[0] * x[0]}}; });
    OdeState x{{1.0}};  // 1/(1 - t) ends at t = 1
    double t = 0;
    EXPECT_THROW(solver.advance(t, x, 2), InvalidArgument);
    EXPECT_NEAR(t, 1, 1e-3);
    EXPECT_THROW(OdeSolver(oscillator, {.relative_tolerance = 0}), InvalidArgument);
}

}  // namespace test_ode_solver
