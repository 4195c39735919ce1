#pragma once
#include <functional>
#include <utility>

#include "numerics/models/grey_model.h"
#include "numerics/models/traced_equations.h"

namespace dynlab::test {

/// Expressions of a tape as formulas are written.
struct Term {
    ExpressionTape* tape;
    ExpressionTape::Node node;
};
inline Term apply(Operation operation, Term a) {
    return {a.tape, a.tape->apply(operation, a.node)};
}
inline Term apply(Operation operation, Term a, Term b) {
    return {a.tape, a.tape->apply(operation, a.node, b.node)};
}
inline Term number(Term like, double value) {
    return {like.tape, like.tape->constant(value)};
}
inline Term operator+(Term a, Term b) {
    return apply(Operation::kAdd, a, b);
}
inline Term operator-(Term a, Term b) {
    return apply(Operation::kSubtract, a, b);
}
inline Term operator*(Term a, Term b) {
    return apply(Operation::kMultiply, a, b);
}
inline Term operator/(Term a, Term b) {
    return apply(Operation::kDivide, a, b);
}
inline Term operator-(Term a) {
    return apply(Operation::kNegate, a);
}
inline Term operator*(double a, Term b) {
    return number(b, a) * b;
}
inline Term sine(Term a) {
    return apply(Operation::kSin, a);
}
inline Term cosine(Term a) {
    return apply(Operation::kCos, a);
}
inline Term hyperbolic_tangent(Term a) {
    return apply(Operation::kTanh, a);
}

/// The variables of a model's functions.
struct Variables {
    Term t, u;
    std::vector<Term> x, p;
};
using Formulas = std::function<std::vector<Term>(const Variables&)>;

inline std::vector<ExpressionTape::Node> nodes_of(const std::vector<Term>& terms) {
    std::vector<ExpressionTape::Node> nodes;
    for (const Term& term : terms) nodes.push_back(term.node);
    return nodes;
}

/// A model with one input. Without `outputs` the first states are measured; without `initial` it starts from zero.
inline GreyModel grey_model(std::vector<GreyParameter> parameters, std::vector<std::string> states,
                            const Formulas& rates, const Formulas& outputs = {}, const Formulas& initial = {}) {
    TracedFunctions functions;
    ExpressionTape& tape = functions.tape;
    Variables v{{&tape, tape.variable(Operation::kTime)}, {&tape, tape.variable(Operation::kInput, 0)}, {}, {}};
    for (std::size_t i = 0; i < states.size(); ++i)
        v.x.push_back({&tape, tape.variable(Operation::kState, static_cast<Index>(i))});
    for (std::size_t i = 0; i < parameters.size(); ++i)
        v.p.push_back({&tape, tape.variable(Operation::kParameter, static_cast<Index>(i))});
    functions.rates = nodes_of(rates(v));
    functions.outputs = nodes_of(outputs ? outputs(v) : v.x);
    functions.initial =
        initial ? nodes_of(initial(v)) : std::vector<ExpressionTape::Node>(states.size(), tape.constant(0));
    functions.inputs = 1;
    GreyModel model;
    model.parameters = std::move(parameters);
    model.state_names = std::move(states);
    model.inputs = 1;
    model.outputs_are_states = !outputs;
    model.estimated_initial.assign(model.state_names.size(), false);
    model.equations = traced_equations(std::move(functions));
    return model;
}

/// dx/dt = -r x + K r u: a gain and a rate.
inline GreyModel first_order(double K, double r) {
    return grey_model({{"K", K}, {"r", r, 0}}, {"x"},
                      [](const Variables& v) -> std::vector<Term> { return {v.p[1] * (v.p[0] * v.u - v.x[0])}; });
}

/// A pendulum with friction, driven by a torque: dphi/dt = w, dw/dt = -a sin(phi) - c w + b u.
inline GreyModel pendulum(double a, double b, double c) {
    return grey_model({{"a", a}, {"b", b}, {"c", c}}, {"phi", "w"}, [](const Variables& v) -> std::vector<Term> {
        return {v.x[1], -v.p[0] * sine(v.x[0]) - v.p[2] * v.x[1] + v.p[1] * v.u};
    });
}

/// Trolley and pendulum of a crane: position, speed, angle, its rate; the motor without its inductance, a rigid belt,
/// dry friction smooth. dv/dt + mu cos(phi) dw/dt - mu sin(phi) w^2 = a u - b v - d tanh(v/v0); cos(phi) dv/dt + L
/// dw/dt + g sin(phi) = -c w.
inline std::vector<Term> crane_rates(const Variables& v) {
    const Term &a = v.p[0], &b = v.p[1], &d = v.p[2], &mu = v.p[3], &L = v.p[4], &c = v.p[5];
    const Term &speed = v.x[1], &phi = v.x[2], &w = v.x[3], co = cosine(phi), si = sine(phi);
    const Term r1 = a * v.u - b * speed - d * hyperbolic_tangent(200 * speed) + mu * si * w * w,
               r2 = -(9.81 * si) - c * w, determinant = L - mu * co * co;
    return {speed, (L * r1 - mu * co * r2) / determinant, w, (r2 - co * r1) / determinant};
}
inline GreyModel crane_model() {
    return grey_model(
        {{"a", 1, 0}, {"b", 15, 0}, {"d", 0.3, 0}, {"mu", 0.05, 0}, {"L", 0.4, 0.1}, {"c", 0.01, 0}, {"zero", 0}},
        {"x", "v", "phi", "w"}, crane_rates, [](const Variables& v) -> std::vector<Term> {
            return {v.x[0], v.x[2] + v.p[6]};
        });
}

}  // namespace dynlab::test
