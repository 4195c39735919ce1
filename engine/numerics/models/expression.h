#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The operation of one line of a tape. Variables represent themselves, by their place.
enum class Operation : std::uint8_t {
    kConstant,
    kTime,
    kState,
    kInput,
    kParameter,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kPower,
    kMaximum,  ///< the first of equal ones
    kMinimum,
    kNegate,
    kSin,
    kCos,
    kTan,
    kTanh,
    kArcTangent,
    kExp,
    kLog,
    kSqrt,
    kAbs,
    kSign,
    kWhere,             ///< the second where the first is positive, else the third
    kReciprocalOrZero,  ///< in derivatives at the edge of a domain: zero instead of infinite
    kPowerOrZero,
    kLogOrZero,
};

/// Expressions as one list of operations in single-assignment form: every line is computed from lines before it, and
/// equal ones are one line. Sums with zero, products with zero or one and operations on constants are simplified as
/// they are written.
class ExpressionTape {
  public:
    using Node = std::int32_t;

    Node constant(double value);
    /// The i-th variable (0-based) of a kind, kTime, kState, kInput or kParameter.
    Node variable(Operation kind, Index i = 0);
    Node apply(Operation operation, Node a, Node b = -1, Node c = -1);

    /// The derivative of an expression with respect to a variable, as an expression of this tape (forward mode, line by
    /// line). Where a function has a corner the side that its value is taken from counts: abs at 0 that above, max and
    /// min of equal values the first; sign has the derivative zero, and so have powers with exponents below one, sqrt
    /// and log at the edge of their domain.
    Node derivative(Node of, Node variable);

    bool depends_on(Node node, Operation kind) const;
    /// The value of an expression of constants only.
    std::optional<double> constant_value(Node node) const;
    Node size() const { return static_cast<Node>(lines_.size()); }

    struct Line {
        Operation operation;
        Node a = -1, b = -1, c = -1;  ///< operands; of a variable a is its place
        double value = 0;             ///< of a constant
    };
    const Line& line(Node node) const { return lines_[static_cast<std::size_t>(node)]; }

  private:
    using Key = std::tuple<Operation, Node, Node, Node, std::uint64_t>;
    Node add(const Line& line);
    bool is(Node node, double value) const;
    std::optional<Node> simplified(Operation operation, Node a, Node b, Node c);
    Node product_sum(Node a, Node by_a, Node b, Node by_b);
    Node derivative_of_line(const Line& line, const std::vector<Node>& known);
    Node derivative_of_power(const Line& line, Node da, Node db);

    std::vector<Line> lines_;
    std::vector<std::uint8_t> kinds_;  ///< of the variables that each line depends on, one bit each
    std::map<Key, Node> known_;
    std::map<Node, std::vector<Node>> derivatives_;  ///< by variable, of each line; -1 where not asked for yet
};

/// The value of an operation on numbers.
double value_of(Operation operation, double a, double b, double c);

/// Some expressions of a tape, ready to be evaluated many times. What depends on parameters alone is computed once for
/// each set of them. Not for several threads at once.
class ExpressionProgram {
  public:
    ExpressionProgram() = default;
    ExpressionProgram(const ExpressionTape& tape, const std::vector<ExpressionTape::Node>& results);

    void set_parameters(const double* parameters);
    /// Evaluates at time t (s), states x and inputs u, which may be shorter than the tape's variables of the kind are
    /// many only where those are not among the expressions' variables.
    void run(double t, const double* x, const double* u);
    double result(std::size_t i) const { return registers_[results_[i]]; }
    std::size_t result_count() const { return results_.size(); }

  private:
    struct Instruction {
        std::uint32_t a, b, c, target;
    };
    struct Step {
        Operation operation;
        Instruction instruction;
    };
    struct Run {
        Operation operation;
        std::size_t length;
    };
    /// Instructions in an order that has few runs of one operation, each of which is chosen once for its whole run: a
    /// choice for each instruction costs more than what it computes.
    struct Schedule {
        std::vector<Run> runs;
        std::vector<Instruction> instructions;
    };
    struct Variable {
        std::size_t place;
        std::uint32_t target;
    };
    Schedule in_runs(const std::vector<Step>& steps) const;
    static void execute(const Schedule& schedule, double* registers);

    Schedule of_parameters_, others_;
    std::vector<Variable> parameters_, states_, inputs_;
    std::vector<std::uint32_t> times_, results_;
    std::vector<double> registers_;
};

}  // namespace dynlab::inline numerics
