#include "numerics/models/traced_equations.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dynlab::inline numerics {
namespace {

using Node = ExpressionTape::Node;

/// The derivatives of some expressions, of which most may be zero or constant.
class SparseDerivatives {
  public:
    SparseDerivatives() = default;
    /// Adds the expressions that are no constants to `results`.
    SparseDerivatives(ExpressionTape& tape, const std::vector<Node>& of, const std::vector<Node>& variables,
                      std::vector<Node>& results)
        : constants_(RowMatrix::Zero(static_cast<Index>(of.size()), static_cast<Index>(variables.size()))) {
        for (std::size_t i = 0; i < of.size(); ++i)
            for (std::size_t j = 0; j < variables.size(); ++j) {
                const Node node = tape.derivative(of[i], variables[j]);
                const auto row = static_cast<Index>(i), column = static_cast<Index>(j);
                if (const auto value = tape.constant_value(node)) {
                    constants_(row, column) = *value;
                } else {
                    places_.push_back({row * constants_.cols() + column, results.size()});
                    results.push_back(node);
                }
            }
    }

    void fill(const ExpressionProgram& program, RowMatrix& target) const {
        target = constants_;
        for (const Place& place : places_) target.data()[place.entry] = program.result(place.result);
    }

  private:
    struct Place {
        Index entry;
        std::size_t result;
    };
    RowMatrix constants_;
    std::vector<Place> places_;
};

/// One vector function with derivatives up to each order that is asked for.
class TracedFunction {
  public:
    TracedFunction() = default;
    TracedFunction(ExpressionTape& tape, const std::vector<Node>& values, const std::vector<Node>& states,
                   const std::vector<Node>& parameters)
        : size_(static_cast<Index>(values.size())) {
        std::vector<Node> results = values;
        programs_[0] = ExpressionProgram(tape, results);
        by_state_ = SparseDerivatives(tape, values, states, results);
        programs_[1] = ExpressionProgram(tape, results);
        by_parameter_ = SparseDerivatives(tape, values, parameters, results);
        programs_[2] = ExpressionProgram(tape, results);
    }

    void set_parameters(const double* parameters) {
        for (ExpressionProgram& program : programs_) program.set_parameters(parameters);
    }

    void evaluate(double t, const double* x, const double* u, Derivatives requested, GreyValues& at) {
        ExpressionProgram& program = programs_[static_cast<std::size_t>(requested)];
        program.run(t, x, u);
        at.values.resize(size_);
        for (Index i = 0; i < size_; ++i) at.values[i] = program.result(static_cast<std::size_t>(i));
        if (requested == Derivatives::kNone) return;
        by_state_.fill(program, at.by_state);
        if (requested == Derivatives::kAll) by_parameter_.fill(program, at.by_parameter);
    }

  private:
    Index size_ = 0;
    std::array<ExpressionProgram, 3> programs_;
    SparseDerivatives by_state_, by_parameter_;
};

std::vector<Node> variables_of(ExpressionTape& tape, Operation kind, Index count) {
    std::vector<Node> all;
    for (Index i = 0; i < count; ++i) all.push_back(tape.variable(kind, i));
    return all;
}

/// The rates as A x + B u + c, whose entries are expressions of the parameters.
class TracedLinearSystem {
  public:
    TracedLinearSystem(ExpressionTape& tape, const std::vector<Node>& rates, Index inputs,
                       const std::vector<Node>& parameters) {
        const auto n = static_cast<Index>(rates.size());
        const std::vector<Node> states = variables_of(tape, Operation::kState, n),
                                input_nodes = variables_of(tape, Operation::kInput, inputs);
        std::vector<Node> entries;
        for (const std::vector<Node>* variables : {&states, &input_nodes})
            for (const Node variable : *variables)
                for (const Node rate : rates) entries.push_back(tape.derivative(rate, variable));
        for (const Node rate : rates) entries.push_back(rate);  // c, at x = 0 and u = 0
        std::vector<Node> results = entries;
        slopes_ = SparseDerivatives(tape, entries, parameters, results);
        program_ = ExpressionProgram(tape, results);
        at_.value = empty(n, inputs);
        at_.by_parameter.assign(parameters.size(), empty(n, inputs));
        zeros_ = Vector::Zero(std::max(n, inputs) + 1);
    }

    void set_parameters(const double* parameters) {
        program_.set_parameters(parameters);
        program_.run(0, zeros_.data(), zeros_.data());
        Vector values(zeros_size());
        for (Index i = 0; i < values.size(); ++i) values[i] = program_.result(static_cast<std::size_t>(i));
        unpack(values, at_.value);
        RowMatrix slopes;
        slopes_.fill(program_, slopes);
        for (std::size_t q = 0; q < at_.by_parameter.size(); ++q)
            unpack(slopes.col(static_cast<Index>(q)), at_.by_parameter[q]);
    }

    const GreyLinearSystem& at() const { return at_; }

  private:
    static GreyLinearSystem::Part empty(Index n, Index inputs) {
        return {Matrix::Zero(n, n), Matrix::Zero(n, inputs), Vector::Zero(n)};
    }
    Index zeros_size() const { return at_.value.A.size() + at_.value.B.size() + at_.value.c.size(); }
    static void unpack(const Vector& values, GreyLinearSystem::Part& part) {
        part.A = values.head(part.A.size()).reshaped(part.A.rows(), part.A.cols());
        part.B = values.segment(part.A.size(), part.B.size()).reshaped(part.B.rows(), part.B.cols());
        part.c = values.tail(part.c.size());
    }

    SparseDerivatives slopes_;
    ExpressionProgram program_;
    GreyLinearSystem at_;
    Vector zeros_;
};

bool varies(const ExpressionTape& tape, Node node) {
    return tape.depends_on(node, Operation::kState) || tape.depends_on(node, Operation::kInput) ||
           tape.depends_on(node, Operation::kTime);
}

/// Whether an expression is a sum of states and inputs, each times something of the parameters alone.
bool is_linear_in_variables(const ExpressionTape& tape, Node node) {
    if (!varies(tape, node)) return true;
    const ExpressionTape::Line& line = tape.line(node);
    switch (line.operation) {
        case Operation::kState:
        case Operation::kInput:
            return true;
        case Operation::kAdd:
        case Operation::kSubtract:
            return is_linear_in_variables(tape, line.a) && is_linear_in_variables(tape, line.b);
        case Operation::kNegate:
            return is_linear_in_variables(tape, line.a);
        case Operation::kMultiply:
            return (!varies(tape, line.a) && is_linear_in_variables(tape, line.b)) ||
                   (!varies(tape, line.b) && is_linear_in_variables(tape, line.a));
        case Operation::kDivide:
            return !varies(tape, line.b) && is_linear_in_variables(tape, line.a);
        default:
            return false;
    }
}

class TracedEvaluation final : public GreyEvaluation {
  public:
    TracedEvaluation(TracedFunctions functions, const std::vector<Index>& with_respect_to, bool linear) {
        ExpressionTape& tape = functions.tape;
        const std::vector<Node> states =
            variables_of(tape, Operation::kState, static_cast<Index>(functions.rates.size()));
        std::vector<Node> parameters;
        for (const Index i : with_respect_to) parameters.push_back(tape.variable(Operation::kParameter, i));
        rates_ = TracedFunction(tape, functions.rates, states, parameters);
        outputs_ = TracedFunction(tape, functions.outputs, states, parameters);
        initial_ = TracedFunction(tape, functions.initial, states, parameters);
        if (linear) linear_ = std::make_unique<TracedLinearSystem>(tape, functions.rates, functions.inputs, parameters);
    }

    void set_parameters(const Vector& parameters) override {
        for (TracedFunction* function : {&rates_, &outputs_, &initial_}) function->set_parameters(parameters.data());
        if (linear_) linear_->set_parameters(parameters.data());
    }
    void rates(double t, const double* x, const double* u, Derivatives requested, GreyValues& at) override {
        rates_.evaluate(t, x, u, requested, at);
    }
    void outputs(double t, const double* x, const double* u, Derivatives requested, GreyValues& at) override {
        outputs_.evaluate(t, x, u, requested, at);
    }
    void initial_state(Derivatives requested, GreyValues& at) override {
        initial_.evaluate(0, nullptr, nullptr, requested, at);
    }
    const GreyLinearSystem* linear_system() override { return linear_ ? &linear_->at() : nullptr; }

  private:
    TracedFunction rates_, outputs_, initial_;
    std::unique_ptr<TracedLinearSystem> linear_;
};

class TracedEquations final : public GreyEquations {
  public:
    explicit TracedEquations(TracedFunctions functions)
        : functions_(std::move(functions)),
          linear_(std::all_of(functions_.rates.begin(), functions_.rates.end(),
                              [&](Node rate) { return is_linear_in_variables(functions_.tape, rate); })) {}
    std::unique_ptr<GreyEvaluation> evaluation(const std::vector<Index>& with_respect_to) const override {
        return std::make_unique<TracedEvaluation>(functions_, with_respect_to, linear_);
    }
    Index output_count() const override { return static_cast<Index>(functions_.outputs.size()); }
    bool is_linear() const override { return linear_; }
    bool has_linear_outputs() const override {
        return std::all_of(functions_.outputs.begin(), functions_.outputs.end(),
                           [&](Node output) { return is_linear_in_variables(functions_.tape, output); });
    }

  private:
    TracedFunctions functions_;
    bool linear_;
};

}  // namespace

std::shared_ptr<const GreyEquations> traced_equations(TracedFunctions functions) {
    return std::make_shared<TracedEquations>(std::move(functions));
}

}  // namespace dynlab::inline numerics
