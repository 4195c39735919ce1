#include "numerics/models/expression.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <deque>
#include <utility>

namespace dynlab::inline numerics {
namespace {

using Node = ExpressionTape::Node;

std::uint8_t kind_bit(Operation kind) {
    return static_cast<std::uint8_t>(1u << static_cast<unsigned>(kind));
}
static_assert(static_cast<int>(Operation::kParameter) < 8);

bool is_leaf(Operation operation) {
    return operation <= Operation::kParameter;
}

int operand_count(Operation operation) {
    if (is_leaf(operation)) return 0;
    if (operation == Operation::kWhere) return 3;
    return operation <= Operation::kMinimum || operation == Operation::kPowerOrZero ? 2 : 1;
}

/// Calls use(f) with the function f(a, b, c) of an operation. Variables already have their value: their f is a.
template <class Use>
void with_function_of(Operation operation, const Use& use) {
    switch (operation) {
        case Operation::kAdd:
            return use([](double a, double b, double) { return a + b; });
        case Operation::kSubtract:
            return use([](double a, double b, double) { return a - b; });
        case Operation::kMultiply:
            return use([](double a, double b, double) { return a * b; });
        case Operation::kDivide:
            return use([](double a, double b, double) { return a / b; });
        case Operation::kPower:
            return use([](double a, double b, double) { return std::pow(a, b); });
        case Operation::kMaximum:
            return use([](double a, double b, double) { return b > a ? b : a; });
        case Operation::kMinimum:
            return use([](double a, double b, double) { return b < a ? b : a; });
        case Operation::kNegate:
            return use([](double a, double, double) { return -a; });
        case Operation::kSin:
            return use([](double a, double, double) { return std::sin(a); });
        case Operation::kCos:
            return use([](double a, double, double) { return std::cos(a); });
        case Operation::kTan:
            return use([](double a, double, double) { return std::tan(a); });
        case Operation::kTanh:
            return use([](double a, double, double) { return std::tanh(a); });
        case Operation::kArcTangent:
            return use([](double a, double, double) { return std::atan(a); });
        case Operation::kExp:
            return use([](double a, double, double) { return std::exp(a); });
        case Operation::kLog:
            return use([](double a, double, double) { return std::log(a); });
        case Operation::kSqrt:
            return use([](double a, double, double) { return std::sqrt(a); });
        case Operation::kAbs:
            return use([](double a, double, double) { return std::abs(a); });
        case Operation::kSign:
            return use([](double a, double, double) { return a > 0 ? 1 : a < 0 ? -1 : a; });
        case Operation::kWhere:
            return use([](double a, double b, double c) { return a > 0 ? b : c; });
        case Operation::kReciprocalOrZero:
            return use([](double a, double, double) { return a == 0 ? 0 : 1 / a; });
        case Operation::kPowerOrZero:
            return use([](double a, double b, double) { return a == 0 && b < 0 ? 0 : std::pow(a, b); });
        case Operation::kLogOrZero:
            return use([](double a, double, double) { return a > 0 ? std::log(a) : 0; });
        default:
            return use([](double a, double, double) { return a; });
    }
}

}  // namespace

double value_of(Operation operation, double a, double b, double c) {
    double value = 0;
    with_function_of(operation, [&](auto function) { value = function(a, b, c); });
    return value;
}

Node ExpressionTape::add(const Line& line) {
    const Key key{line.operation, line.a, line.b, line.c, std::bit_cast<std::uint64_t>(line.value)};
    const auto [place, is_new] = known_.emplace(key, size());
    if (!is_new) return place->second;
    std::uint8_t kinds = 0;
    if (is_leaf(line.operation)) {
        if (line.operation != Operation::kConstant) kinds = kind_bit(line.operation);
    } else {
        for (const Node operand : {line.a, line.b, line.c})
            if (operand >= 0) kinds |= kinds_[static_cast<std::size_t>(operand)];
    }
    lines_.push_back(line);
    kinds_.push_back(kinds);
    return size() - 1;
}

Node ExpressionTape::constant(double value) {
    return add({Operation::kConstant, -1, -1, -1, value == 0 ? 0 : value});
}

Node ExpressionTape::variable(Operation kind, Index i) {
    return add({kind, static_cast<Node>(i), -1, -1, 0});
}

bool ExpressionTape::depends_on(Node node, Operation kind) const {
    return (kinds_[static_cast<std::size_t>(node)] & kind_bit(kind)) != 0;
}

std::optional<double> ExpressionTape::constant_value(Node node) const {
    if (line(node).operation != Operation::kConstant) return std::nullopt;
    return line(node).value;
}

bool ExpressionTape::is(Node node, double value) const {
    return node >= 0 && constant_value(node) == value;
}

std::optional<Node> ExpressionTape::simplified(Operation operation, Node a, Node b, Node c) {
    switch (operation) {
        case Operation::kAdd:
            if (is(a, 0)) return b;
            if (is(b, 0)) return a;
            break;
        case Operation::kSubtract:
            if (is(b, 0)) return a;
            if (is(a, 0)) return apply(Operation::kNegate, b);
            if (a == b) return constant(0);
            break;
        case Operation::kMultiply:
            if (is(a, 0) || is(b, 0)) return constant(0);
            if (is(a, 1)) return b;
            if (is(b, 1)) return a;
            if (is(a, -1)) return apply(Operation::kNegate, b);
            if (is(b, -1)) return apply(Operation::kNegate, a);
            break;
        case Operation::kDivide:
            if (is(a, 0)) return a;
            if (is(b, 1)) return a;
            break;
        case Operation::kPower:
        case Operation::kPowerOrZero:
            if (is(b, 0)) return constant(1);
            if (is(b, 1)) return a;
            if (is(b, 2)) return apply(Operation::kMultiply, a, a);
            break;
        case Operation::kNegate:
            if (line(a).operation == Operation::kNegate) return line(a).a;
            break;
        case Operation::kWhere:
            if (b == c) return b;
            break;
        default:
            break;
    }
    return std::nullopt;
}

Node ExpressionTape::apply(Operation operation, Node a, Node b, Node c) {
    const int operands = operand_count(operation);
    const auto value = [&](Node node, int place) { return place < operands ? constant_value(node) : 0; };
    const auto va = value(a, 0), vb = value(b, 1), vc = value(c, 2);
    if (va && vb && vc) return constant(value_of(operation, *va, *vb, *vc));
    if (const auto simple = simplified(operation, a, b, c)) return *simple;
    const bool commutes = operation == Operation::kAdd || operation == Operation::kMultiply;
    if (commutes && b < a) std::swap(a, b);
    return add({operation, a, b, c, 0});
}

Node ExpressionTape::product_sum(Node a, Node by_a, Node b, Node by_b) {
    return apply(Operation::kAdd, apply(Operation::kMultiply, a, by_a), apply(Operation::kMultiply, b, by_b));
}

// d(a^b) = b a^(b-1) da + a^b log(a) db
Node ExpressionTape::derivative_of_power(const Line& line, Node da, Node db) {
    const Node less = apply(Operation::kSubtract, line.b, constant(1));
    const Node slope = apply(Operation::kMultiply, line.b, apply(Operation::kPowerOrZero, line.a, less));
    const Node growth = is(db, 0) ? constant(0)
                                  : apply(Operation::kMultiply, apply(Operation::kPower, line.a, line.b),
                                          apply(Operation::kLogOrZero, line.a));
    return product_sum(slope, da, growth, db);
}

Node ExpressionTape::derivative_of_line(const Line& line, const std::vector<Node>& known) {
    const auto of = [&](Node node) { return node < 0 ? constant(0) : known[static_cast<std::size_t>(node)]; };
    const Node a = line.a, b = line.b, da = of(a), db = of(b), dc = of(line.c);
    if (is(da, 0) && is(db, 0) && is(dc, 0)) return constant(0);
    const Node self = apply(line.operation, a, b, line.c);
    const auto chain = [&](Node slope) { return apply(Operation::kMultiply, slope, da); };
    switch (line.operation) {
        case Operation::kAdd:
        case Operation::kSubtract:
            return apply(line.operation, da, db);
        case Operation::kMultiply:
            return product_sum(b, da, a, db);
        case Operation::kDivide:  // (da - (a/b) db)/b
            return apply(Operation::kDivide, apply(Operation::kSubtract, da, apply(Operation::kMultiply, self, db)), b);
        case Operation::kPower:
        case Operation::kPowerOrZero:
            return derivative_of_power(line, da, db);
        case Operation::kMaximum:
            return apply(Operation::kWhere, apply(Operation::kSubtract, b, a), db, da);
        case Operation::kMinimum:
            return apply(Operation::kWhere, apply(Operation::kSubtract, a, b), db, da);
        case Operation::kNegate:
            return apply(Operation::kNegate, da);
        case Operation::kSin:
            return chain(apply(Operation::kCos, a));
        case Operation::kCos:
            return chain(apply(Operation::kNegate, apply(Operation::kSin, a)));
        case Operation::kTan:
            return chain(apply(Operation::kAdd, constant(1), apply(Operation::kMultiply, self, self)));
        case Operation::kTanh:
            return chain(apply(Operation::kSubtract, constant(1), apply(Operation::kMultiply, self, self)));
        case Operation::kArcTangent:
            return apply(Operation::kDivide, da,
                         apply(Operation::kAdd, constant(1), apply(Operation::kMultiply, a, a)));
        case Operation::kExp:
            return chain(self);
        case Operation::kLog:
            return chain(apply(Operation::kReciprocalOrZero, a));
        case Operation::kSqrt:
            return chain(apply(Operation::kMultiply, constant(0.5), apply(Operation::kReciprocalOrZero, self)));
        case Operation::kAbs:
            return apply(Operation::kWhere, apply(Operation::kNegate, a), apply(Operation::kNegate, da), da);
        case Operation::kWhere:
            return apply(Operation::kWhere, a, db, dc);
        case Operation::kReciprocalOrZero:
            return chain(apply(Operation::kNegate, apply(Operation::kMultiply, self, self)));
        case Operation::kLogOrZero:
            return chain(apply(Operation::kReciprocalOrZero, a));
        default:
            return constant(0);  // sign
    }
}

Node ExpressionTape::derivative(Node of, Node variable) {
    std::vector<Node> known = std::move(derivatives_[variable]);
    known.resize(static_cast<std::size_t>(std::max<Node>(of + 1, static_cast<Node>(known.size()))), -1);
    std::vector<bool> needed(static_cast<std::size_t>(of + 1));
    needed.back() = true;
    for (Node node = of; node >= 0; --node) {
        if (!needed[static_cast<std::size_t>(node)] || is_leaf(line(node).operation)) continue;
        for (const Node operand : {line(node).a, line(node).b, line(node).c})
            if (operand >= 0) needed[static_cast<std::size_t>(operand)] = true;
    }
    for (Node node = 0; node <= of; ++node) {
        Node& found = known[static_cast<std::size_t>(node)];
        if (!needed[static_cast<std::size_t>(node)] || found >= 0) continue;
        const Line own = line(node);  // a copy: more lines are written meanwhile
        found = is_leaf(own.operation) ? constant(node == variable ? 1 : 0) : derivative_of_line(own, known);
    }
    const Node result = known[static_cast<std::size_t>(of)];
    derivatives_[variable] = std::move(known);
    return result;
}

ExpressionProgram::ExpressionProgram(const ExpressionTape& tape, const std::vector<Node>& results) {
    std::vector<bool> needed(static_cast<std::size_t>(tape.size()));
    for (const Node node : results) needed[static_cast<std::size_t>(node)] = true;
    for (Node node = tape.size() - 1; node >= 0; --node) {
        const ExpressionTape::Line& line = tape.line(node);
        if (!needed[static_cast<std::size_t>(node)] || is_leaf(line.operation)) continue;
        for (const Node operand : {line.a, line.b, line.c})
            if (operand >= 0) needed[static_cast<std::size_t>(operand)] = true;
    }
    std::vector<Step> of_parameters, others;
    std::vector<std::uint32_t> places(static_cast<std::size_t>(tape.size()));
    const auto place = [&](Node node) { return node < 0 ? 0 : places[static_cast<std::size_t>(node)]; };
    for (Node node = 0; node < tape.size(); ++node) {
        if (!needed[static_cast<std::size_t>(node)]) continue;
        const ExpressionTape::Line& line = tape.line(node);
        const auto target = static_cast<std::uint32_t>(registers_.size());
        places[static_cast<std::size_t>(node)] = target;
        registers_.push_back(line.value);
        const Variable variable{static_cast<std::size_t>(std::max<Node>(line.a, 0)), target};
        const bool varies = tape.depends_on(node, Operation::kTime) || tape.depends_on(node, Operation::kState) ||
                            tape.depends_on(node, Operation::kInput);
        switch (line.operation) {
            case Operation::kConstant:
                break;
            case Operation::kTime:
                times_.push_back(target);
                break;
            case Operation::kState:
                states_.push_back(variable);
                break;
            case Operation::kInput:
                inputs_.push_back(variable);
                break;
            case Operation::kParameter:
                parameters_.push_back(variable);
                break;
            default:
                (varies ? others : of_parameters)
                    .push_back({line.operation, {place(line.a), place(line.b), place(line.c), target}});
        }
    }
    of_parameters_ = in_runs(of_parameters);
    others_ = in_runs(others);
    for (const Node node : results) results_.push_back(place(node));
}

// Always the operation that most steps are ready for, as long as one is.
ExpressionProgram::Schedule ExpressionProgram::in_runs(const std::vector<Step>& steps) const {
    constexpr std::size_t kOperations = static_cast<std::size_t>(Operation::kLogOrZero) + 1;
    std::vector<std::vector<std::size_t>> readers(registers_.size());
    std::vector<bool> is_computed(registers_.size());
    for (const Step& step : steps) is_computed[step.instruction.target] = true;
    std::vector<int> missing(steps.size());
    std::array<std::deque<std::size_t>, kOperations> ready;
    const auto make_ready = [&](std::size_t i) { ready[static_cast<std::size_t>(steps[i].operation)].push_back(i); };
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Instruction& one = steps[i].instruction;
        const std::uint32_t operands[] = {one.a, one.b, one.c};
        for (int k = 0; k < operand_count(steps[i].operation); ++k) {
            if (!is_computed[operands[k]]) continue;
            readers[operands[k]].push_back(i);
            ++missing[i];
        }
        if (missing[i] == 0) make_ready(i);
    }
    Schedule schedule;
    while (schedule.instructions.size() < steps.size()) {
        const auto largest_group = std::max_element(ready.begin(), ready.end(),
                                                    [](const auto& a, const auto& b) { return a.size() < b.size(); });
        const std::size_t begin = schedule.instructions.size();
        for (; !largest_group->empty(); largest_group->pop_front()) {
            const Instruction& one = steps[largest_group->front()].instruction;
            schedule.instructions.push_back(one);
            for (const std::size_t reader : readers[one.target])
                if (--missing[reader] == 0) make_ready(reader);
        }
        schedule.runs.push_back(
            {static_cast<Operation>(largest_group - ready.begin()), schedule.instructions.size() - begin});
    }
    return schedule;
}

void ExpressionProgram::execute(const Schedule& schedule, double* registers) {
    const Instruction* one = schedule.instructions.data();
    for (const Run& run : schedule.runs)
        with_function_of(run.operation, [&](auto function) {
            for (const Instruction* const end = one + run.length; one != end; ++one)
                registers[one->target] = function(registers[one->a], registers[one->b], registers[one->c]);
        });
}

void ExpressionProgram::set_parameters(const double* parameters) {
    for (const Variable& variable : parameters_) registers_[variable.target] = parameters[variable.place];
    execute(of_parameters_, registers_.data());
}

void ExpressionProgram::run(double t, const double* x, const double* u) {
    for (const std::uint32_t target : times_) registers_[target] = t;
    for (const Variable& variable : states_) registers_[variable.target] = x[variable.place];
    for (const Variable& variable : inputs_) registers_[variable.target] = u[variable.place];
    execute(others_, registers_.data());
}

}  // namespace dynlab::inline numerics
