#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/models/called_equations.h"
#include "numerics/signals/prbs.h"
#include "numerics/simulation/grey_simulation.h"
#include "numerics/simulation/lsim.h"
#include "numerics/simulation/ode_solver.h"
#include "numerics/simulation/sensitivity_solver.h"
#include "support/grey_cases.h"
#include "support/thrown_message.h"

namespace test_grey_simulation {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

GreyInputs inputs_of(const Vector& u, double Ts, Hold hold = Hold::kZoh) {
    return {Matrix(u), Vector(Ts * Vector::LinSpaced(u.size(), 0, static_cast<double>(u.size() - 1))), hold};
}

Matrix outputs_of(const GreyModel& model, const Vector& p, const GreyInputs& inputs, double tolerance,
                  Index outputs = 1) {
    return GreySimulator(model, outputs, {}, tolerance).run(p, inputs, {}, false).y;
}

TEST(grey_simulation, of_linear_equations_is_lsim) {  // oracle: second route, lsim
    const Vector u = prbs(5, 3), p{{2, 0.7}};
    const TransferFunction G(Vector{{1.4}}, Vector{{1, 0.7}});
    for (const Hold hold : {Hold::kZoh, Hold::kFoh}) {
        const Vector expected = lsim(G, u, 0.3, hold);
        const Matrix exact = outputs_of(first_order(1, 1), p, inputs_of(u, 0.3, hold), 1e-7);
        EXPECT_LT((exact.col(0) - expected).cwiseAbs().maxCoeff(), 1e-13);
        // The same equation written so that it is solved step by step.
        const GreyModel curved = grey_model({{"K", 1}, {"r", 1}}, {"x"}, [](const Variables& v) -> std::vector<Term> {
            return {v.p[1] * (v.p[0] * v.u - v.x[0]) + 1e-30 * sine(v.x[0])};
        });
        const Matrix stepped = outputs_of(curved, p, inputs_of(u, 0.3, hold), 1e-10);
        EXPECT_LT((stepped.col(0) - expected).cwiseAbs().maxCoeff(), 1e-9);
    }
}

TEST(grey_simulation, of_a_pendulum_agrees_with_the_plants_solver) {  // oracle: second route, OdeSolver at 1e-12
    const Vector u = prbs(4, 5), p{{9, 4, 0.3}};
    const Matrix y = outputs_of(pendulum(1, 1, 1), p, inputs_of(u, 0.1), 1e-9, 2);
    OdeOptions tight;
    tight.relative_tolerance = 1e-12;
    OdeState x = OdeState::Zero(2);
    for (Index k = 0; k + 1 < u.size(); ++k) {
        OdeSolver solver(
            [&](double, const OdeState& s) -> OdeState {
                return Eigen::Vector2d(s[1], -9 * std::sin(s[0]) - 0.3 * s[1] + 4 * u[k]);
            },
            tight);
        double t = 0;
        solver.advance(t, x, 0.1);
        EXPECT_LT((y.row(k + 1).transpose() - x).norm(), 1e-6) << k;
    }
    EXPECT_GT(y.col(0).cwiseAbs().maxCoeff(), 1);  // far from linear
}

/// Fourth-order central differences of the outputs.
Matrix differences(const GreyModel& model, const Vector& p, const GreyInputs& inputs, Index outputs) {
    Matrix all(inputs.t.size() * outputs, p.size());
    for (Index q = 0; q < p.size(); ++q) {
        const double h = 2e-3 * std::max(0.1, std::abs(p[q]));
        const auto at = [&](double steps) -> Vector {
            return outputs_of(model, p + steps * h * Vector::Unit(p.size(), q), inputs, 1e-13, outputs).reshaped();
        };
        all.col(q) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
    }
    return all;
}

void expect_exact_sensitivities(const GreyModel& model, const Vector& p, const GreyInputs& inputs, Index outputs,
                                double tolerance) {
    std::vector<Index> all(static_cast<std::size_t>(p.size()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
    const Matrix S = GreySimulator(model, outputs, {all, {}}, 1e-11).run(p, inputs, {}, true).sensitivities;
    const Matrix expected = differences(model, p, inputs, outputs);
    for (Index q = 0; q < p.size(); ++q)
        EXPECT_LT((S.col(q) - expected.col(q)).cwiseAbs().maxCoeff(),
                  tolerance * std::max(1., expected.col(q).cwiseAbs().maxCoeff()))
            << model.parameters[static_cast<std::size_t>(q)].name;
}

TEST(grey_simulation, sensitivities_agree_with_differences) {  // oracle: central differences of fourth order
    const GreyInputs some = inputs_of(prbs(4, 3), 0.1), straight = inputs_of(prbs(4, 3), 0.1, Hold::kFoh);
    expect_exact_sensitivities(first_order(1, 1), Vector{{2, 0.7}}, some, 1, 1e-7);
    expect_exact_sensitivities(first_order(1, 1), Vector{{2, 0.7}}, straight, 1, 1e-7);
    expect_exact_sensitivities(pendulum(1, 1, 1), Vector{{5, 1.5, 0.3}}, some, 2, 1e-7);
    expect_exact_sensitivities(pendulum(1, 1, 1), Vector{{5, 1.5, 0.3}}, straight, 1, 1e-7);
}

/// Van der Pol's oscillator, relaxing within 1/(1000 mu) of its time.
GreyModel van_der_pol() {
    return grey_model(
        {{"mu", 1000}}, {"x", "y"},
        [](const Variables& v) -> std::vector<Term> {
            const Term one = number(v.u, 1);
            return {v.x[1], v.p[0] * v.p[0] * ((one - v.x[0] * v.x[0]) * v.x[1] - v.x[0]) + v.u};
        },
        {},
        [](const Variables& v) -> std::vector<Term> {
            return {number(v.u, 2), number(v.u, 0)};
        });
}

// Oracle: published reference solution of the stiff problem (Hairer and Wanner 1996, section IV.10; mu^2 = 1e6): at t =
// 1 and 2.
TEST(grey_simulation, solves_stiff_equations) {
    const GreyModel model = van_der_pol();
    GreySimulator simulator(model, 2, {}, 1e-8);
    const GreyInputs inputs = inputs_of(Vector::Zero(21), 0.1);
    const GreyTrajectory run = simulator.run(Vector{{1000}}, inputs, {}, false);
    EXPECT_TRUE(run.stiff);
    EXPECT_NEAR(run.y(10, 0), -1.863646254808130, 1e-4);
    EXPECT_NEAR(run.y(20, 0), 1.706167732170469, 1e-4);
}

// Oracle: central differences of sixth order (Richardson). The fast rate k moves the outputs by a ten-thousandth of
// what c does, so that its differences and its derivative want the outputs to 13 and 12 digits.
TEST(grey_simulation, of_stiff_equations_has_exact_sensitivities) {
    // A fast and a slow state, curved: the slow one drives the fast one 10^4 times as quickly.
    const GreyModel model =
        grey_model({{"k", 1e4}, {"c", 1}}, {"slow", "fast"}, [](const Variables& v) -> std::vector<Term> {
            return {-v.p[1] * v.x[0] + v.u + 0.1 * sine(v.x[1]), v.p[0] * (sine(v.x[0]) - v.x[1])};
        });
    const GreyInputs inputs = inputs_of(prbs(4, 3), 0.2);
    const Vector p{{1e4, 1}}, steps{{400, 5e-3}}, tolerances{{1e-12, 1e-9}};
    EXPECT_TRUE(GreySimulator(model, 2, {}, 1e-8).run(p, inputs, {}, false).stiff);
    for (const Index q : {0, 1}) {
        const Vector S =
            GreySimulator(model, 2, {{q}, {}}, tolerances[q]).run(p, inputs, {}, true).sensitivities.col(0);
        const auto at = [&](double step) -> Vector {
            return outputs_of(model, p + step * steps[q] * Vector::Unit(2, q), inputs, 1e-13, 2).reshaped();
        };
        const auto difference = [&](double h) -> Vector {
            return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h * steps[q]);
        };
        const Vector expected = (16 * difference(0.5) - difference(1)) / 15;
        EXPECT_LT((S - expected).cwiseAbs().maxCoeff(), 1e-7 * expected.cwiseAbs().maxCoeff()) << q;
    }
}

TEST(grey_simulation, called_functions_give_what_traced_ones_give) {  // oracle: second route
    CalledFunctions functions;
    functions.states = 2;
    functions.inputs = 1;
    functions.outputs_count = 2;
    functions.rates = [](double, const Vector& x, const Vector& u, const Vector& p) -> Vector {
        return Vector{{x[1], -p[0] * std::sin(x[0]) - p[2] * x[1] + p[1] * u[0]}};
    };
    functions.outputs = [](double, const Vector& x, const Vector&, const Vector&) { return x; };
    functions.initial_state = [](const Vector&) -> Vector { return Vector::Zero(2); };
    GreyModel called = pendulum(1, 1, 1);
    const GreyModel traced = called;
    called.equations = called_equations(functions);
    const GreyInputs inputs = inputs_of(prbs(4, 3), 0.1);
    const Vector p{{5, 1.5, 0.3}};
    const GreyTrajectory
        a = GreySimulator(called, 2, {{0, 2}, {1}}, 1e-9).run(p, inputs, {nullptr, Vector{{0.5}}}, true),
        b = GreySimulator(traced, 2, {{0, 2}, {1}}, 1e-9).run(p, inputs, {nullptr, Vector{{0.5}}}, true);
    EXPECT_LT((a.y - b.y).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LT((a.sensitivities - b.sensitivities).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(grey_simulation, reports_when_and_which_state_becomes_infinite) {  // oracle: dx/dt = x^2 from 1 escapes at t = 1
    const GreyModel escaping = grey_model(
        {{"k", 1}}, {"h"}, [](const Variables& v) -> std::vector<Term> { return {v.p[0] * v.x[0] * v.x[0]}; }, {},
        [](const Variables& v) -> std::vector<Term> { return {number(v.u, 1)}; });
    const GreyInputs inputs = inputs_of(Vector::Zero(21), 0.1);
    const std::string message = thrown_message([&] { outputs_of(escaping, Vector{{1}}, inputs, 1e-7); });
    EXPECT_THAT(message, HasSubstr("the state h becomes infinite"));
    const double time = std::stod(message.substr(message.find("= ") + 2));
    EXPECT_NEAR(time, 1, 1e-3) << message;
}

TEST(grey_simulation,
     reports_a_derivative_that_is_no_number) {  // oracle: sqrt below zero, after 2 s of emptying at 0.5
    const GreyModel tank = grey_model(
        {{"k", 1}}, {"h"},
        [](const Variables& v) -> std::vector<Term> {
            return {-1e-9 * apply(Operation::kSqrt, v.x[0]) - 0.5 * v.p[0]};
        },
        {}, [](const Variables& v) -> std::vector<Term> { return {number(v.u, 1)}; });
    const std::string message =
        thrown_message([&] { outputs_of(tank, Vector{{1}}, inputs_of(Vector::Zero(41), 0.1), 1e-7); });
    EXPECT_THAT(message, testing::AnyOf(HasSubstr("the derivative of the state h is NaN"), HasSubstr("h becomes")));
}

TEST(grey_simulation, goes_on_where_equations_jump) {  // oracle: dv/dt = u - d sign(v) by hand
    const GreyModel sliding = grey_model({{"d", 1}}, {"v"}, [](const Variables& v) -> std::vector<Term> {
        return {v.u - v.p[0] * apply(Operation::kSign, v.x[0])};
    });
    Vector u = Vector::Constant(31, 2);
    u.tail(21).setZero();  // 1 s of pushing with 2 - 1, then braking with 1: at rest after 2 s
    const GreyTrajectory run = GreySimulator(sliding, 1, {}, 1e-7).run(Vector{{1}}, inputs_of(u, 0.1), {}, false);
    EXPECT_NEAR(run.y(10, 0), 1, 1e-3);
    EXPECT_NEAR(run.y(15, 0), 0.5, 1e-3);
    EXPECT_LT(std::abs(run.y(30, 0)), 2e-3);
    EXPECT_FALSE(run.rough_times.empty());
}

}  // namespace test_grey_simulation
