#include <gtest/gtest.h>

#include <cmath>

#include "numerics/models/expression.h"

namespace test_expression {

using namespace dynlab;
using Node = ExpressionTape::Node;

double evaluated(const ExpressionTape& tape, Node node, const Vector& x, const Vector& p) {
    ExpressionProgram program(tape, {node});
    program.set_parameters(p.data());
    program.run(0, x.data(), nullptr);
    return program.result(0);
}

/// Every operation of one or two arguments, away from corners.
struct Case {
    Operation operation;
    double a, b;
    bool binary;
};
const std::vector<Case> kCases = {{Operation::kAdd, 0.7, -1.3, true},
                                  {Operation::kSubtract, 0.7, -1.3, true},
                                  {Operation::kMultiply, 0.7, -1.3, true},
                                  {Operation::kDivide, 0.7, -1.3, true},
                                  {Operation::kPower, 1.7, -1.3, true},
                                  {Operation::kMaximum, 0.7, -1.3, true},
                                  {Operation::kMinimum, 0.7, -1.3, true},
                                  {Operation::kNegate, 0.7, 0, false},
                                  {Operation::kSin, 0.7, 0, false},
                                  {Operation::kCos, 0.7, 0, false},
                                  {Operation::kTan, 0.7, 0, false},
                                  {Operation::kTanh, 0.7, 0, false},
                                  {Operation::kArcTangent, 0.7, 0, false},
                                  {Operation::kExp, 0.7, 0, false},
                                  {Operation::kLog, 0.7, 0, false},
                                  {Operation::kSqrt, 0.7, 0, false},
                                  {Operation::kAbs, -0.7, 0, false},
                                  {Operation::kSign, -0.7, 0, false},
                                  {Operation::kReciprocalOrZero, 0.7, 0, false}};

TEST(expression, derivatives_agree_with_differences) {  // oracle: central differences of the operation on numbers
    for (const Case& one : kCases) {
        ExpressionTape tape;
        const Node x = tape.variable(Operation::kState, 0), p = tape.variable(Operation::kParameter, 0);
        const Node f = tape.apply(one.operation, x, one.binary ? p : -1);
        const auto value = [&](double a, double b) { return value_of(one.operation, a, b, 0); };
        EXPECT_EQ(evaluated(tape, f, Vector::Constant(1, one.a), Vector::Constant(1, one.b)), value(one.a, one.b));
        const double h = 1e-6;
        const double by_x = (value(one.a + h, one.b) - value(one.a - h, one.b)) / (2 * h);
        const double by_p = (value(one.a, one.b + h) - value(one.a, one.b - h)) / (2 * h);
        const Vector at_x = Vector::Constant(1, one.a), at_p = Vector::Constant(1, one.b);
        EXPECT_NEAR(evaluated(tape, tape.derivative(f, x), at_x, at_p), by_x, 1e-8) << static_cast<int>(one.operation);
        if (!one.binary) continue;
        EXPECT_NEAR(evaluated(tape, tape.derivative(f, p), at_x, at_p), by_p, 1e-8) << static_cast<int>(one.operation);
    }
}

TEST(expression, of_a_chain_has_the_derivative_by_hand) {  // oracle: d/dx [p x^2 exp(-x) + where(x - 1, x, 2 x)]
    ExpressionTape tape;
    const Node x = tape.variable(Operation::kState, 0), p = tape.variable(Operation::kParameter, 0);
    const Node square = tape.apply(Operation::kPower, x, tape.constant(2));
    const Node bell = tape.apply(Operation::kMultiply, tape.apply(Operation::kMultiply, p, square),
                                 tape.apply(Operation::kExp, tape.apply(Operation::kNegate, x)));
    const Node kink = tape.apply(Operation::kWhere, tape.apply(Operation::kSubtract, x, tape.constant(1)), x,
                                 tape.apply(Operation::kMultiply, tape.constant(2), x));
    const Node f = tape.apply(Operation::kAdd, bell, kink);
    for (const double at : {0.4, 1.9}) {
        const double expected = 3 * (2 * at - at * at) * std::exp(-at) + (at > 1 ? 1 : 2);
        EXPECT_NEAR(evaluated(tape, tape.derivative(f, x), Vector::Constant(1, at), Vector::Constant(1, 3)), expected,
                    1e-13);
    }
}

TEST(expression, corners_take_the_side_of_the_value) {  // oracle: definition
    ExpressionTape tape;
    const Node x = tape.variable(Operation::kState, 0), p = tape.variable(Operation::kParameter, 0);
    const Vector zero = Vector::Zero(1);
    const auto slope = [&](Node f, Node of) { return evaluated(tape, tape.derivative(f, of), zero, zero); };
    EXPECT_EQ(slope(tape.apply(Operation::kAbs, x), x), 1);
    EXPECT_EQ(slope(tape.apply(Operation::kMaximum, x, p), x), 1);
    EXPECT_EQ(slope(tape.apply(Operation::kMaximum, x, p), p), 0);
    EXPECT_EQ(slope(tape.apply(Operation::kMinimum, p, x), p), 1);
    EXPECT_EQ(slope(tape.apply(Operation::kSqrt, x), x), 0);
    EXPECT_EQ(slope(tape.apply(Operation::kPower, x, tape.constant(0.5)), x), 0);
}

TEST(expression, equal_expressions_are_one_line) {  // oracle: definition
    ExpressionTape tape;
    const Node x = tape.variable(Operation::kState, 0), y = tape.variable(Operation::kState, 1);
    EXPECT_EQ(tape.apply(Operation::kAdd, x, y), tape.apply(Operation::kAdd, y, x));
    EXPECT_EQ(tape.apply(Operation::kMultiply, x, tape.constant(1)), x);
    EXPECT_EQ(tape.constant_value(tape.apply(Operation::kMultiply, x, tape.constant(0))), 0);
    EXPECT_EQ(tape.constant_value(tape.apply(Operation::kSubtract, tape.constant(5), tape.constant(3))), 2);
    EXPECT_NE(tape.apply(Operation::kSubtract, x, y), tape.apply(Operation::kSubtract, y, x));
    EXPECT_TRUE(tape.depends_on(tape.apply(Operation::kSin, y), Operation::kState));
    EXPECT_FALSE(tape.depends_on(tape.apply(Operation::kSin, y), Operation::kParameter));
}

}  // namespace test_expression
