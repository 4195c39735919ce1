#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/interpolation.h"
#include "scripting/bind/bindings.h"
#include "scripting/objects/boxed.h"
#include "scripting/objects/numeric_tables.h"

namespace dynlab::inline scripting {
namespace {

int make_vector(Call& call) {
    call.at_most(1);
    if (to_vector(call.state(), 1) == nullptr && call.type(1) != LUA_TTABLE)
        throw InvalidArgument("a vector is written with braces: vector{1, 2, 3}");
    const VectorMap values = call.vector(1, "values");
    return call.give_vector(values);
}

int make_matrix(Call& call) {
    call.at_most(1);
    if (call.type(1) != LUA_TTABLE)
        throw InvalidArgument(
            "a matrix is written with braces: matrix{{1, 2}, {3, 4}} (rows) or matrix{v1, v2} (columns)");
    make_matrix_of_table(call.state(), 1, "argument 1 (rows or columns)");
    return 1;
}

/// Pushes n values, or an n x m matrix when a second size other than 1 is given; returns the room for them.
Eigen::Map<Vector> room(Call& call, int first) {
    const Index rows = call.size(first, "n"), columns = call.given(first + 1) ? call.size(first + 1, "m") : 1;
    NumericBlock& block = columns == 1 ? push_vector(call.state(), rows) : push_matrix(call.state(), rows, columns);
    return block.vector();
}

int zeros(Call& call) {
    call.at_most(2);
    room(call, 1).setZero();
    return 1;
}
int ones(Call& call) {
    call.at_most(2);
    room(call, 1).setOnes();
    return 1;
}
int eye(Call& call) {
    call.at_most(1);
    const Index n = call.size(1, "n");
    push_matrix(call.state(), n, n).matrix().setIdentity();
    return 1;
}
int linspace(Call& call) {
    call.at_most(3);
    const double first = call.number(1, "first"), last = call.number(2, "last");
    if (!std::isfinite(first) || !std::isfinite(last)) throw InvalidArgument("first and last must be finite numbers");
    const Index count = call.given(3) ? call.size(3, "n") : 100;
    push_vector(call.state(), count).vector() = Vector::LinSpaced(count, first, last);
    return 1;
}

int range(Call& call) {
    call.at_most(3);
    const double first = call.number(1, "first"), last = call.number(call.given(3) ? 3 : 2, "last");
    const double step = call.given(3) ? call.number(2, "step") : 1;
    if (step == 0 || !std::isfinite(step)) throw InvalidArgument("the step must be a number other than zero");
    const double count = std::floor((last - first) / step * (1 + 1e-15) + 1e-10) + 1;
    if (!std::isfinite(count)) throw InvalidArgument("first and last must be finite numbers");
    NumericBlock& block = push_vector(call.state(), static_cast<Index>(std::clamp(count, 0.0, 1e15)));
    for (Index k = 0; k < block.rows; ++k) block.data()[k] = first + static_cast<double>(k) * step;
    return 1;
}

VectorMap not_empty(Call& call, int index, const char* what) {
    const VectorMap v = call.vector(index, what);
    if (v.size() == 0) throw InvalidArgument(fmt::format("argument {} ({}) has no elements", index, what));
    return v;
}

double variance_of(const VectorMap& v) {
    if (v.size() < 2)
        throw InvalidArgument("the spread of a single value is not defined; at least two values are needed");
    return (v.array() - v.mean()).square().sum() / static_cast<double>(v.size() - 1);
}

int sum(Call& call) {
    call.at_most(1);
    return call.give(call.vector(1, "v").sum());
}
int mean(Call& call) {
    call.at_most(1);
    return call.give(not_empty(call, 1, "v").mean());
}
int variance(Call& call) {
    call.at_most(1);
    return call.give(variance_of(not_empty(call, 1, "v")));
}
int standard_deviation(Call& call) {
    call.at_most(1);
    return call.give(std::sqrt(variance_of(not_empty(call, 1, "v"))));
}
int norm(Call& call) {
    call.at_most(1);
    return call.give(call.vector(1, "v").norm());
}

int dot(Call& call) {
    call.at_most(2);
    const VectorMap a = call.vector(1, "a"), b = call.vector(2, "b");
    if (a.size() != b.size()) throw InvalidArgument(fmt::format("a has {} values, but b has {}", a.size(), b.size()));
    return call.give(a.dot(b));
}

/// max(v) gives the value and its place; max(x, y) the larger one, element by element.
template <bool kLargest>
int extreme(Call& call) {
    call.at_most(2);
    auto better = [](double x, double y) { return kLargest ? std::fmax(x, y) : std::fmin(x, y); };
    if (call.given(2) && call.type(1) == LUA_TNUMBER && call.type(2) == LUA_TNUMBER)
        return call.give(better(call.number(1, "x"), call.number(2, "y")));
    if (call.given(2)) {
        const int vector_index = call.type(1) == LUA_TNUMBER ? 2 : 1, other = 3 - vector_index;
        const VectorMap v = call.vector(vector_index, vector_index == 1 ? "x" : "y");
        if (call.type(other) == LUA_TNUMBER) {
            const double bound = call.number(other, "bound");
            return call.give_vector(v.unaryExpr([&](double x) { return better(x, bound); }));
        }
        const VectorMap w = call.vector(other, "y");
        if (v.size() != w.size())
            throw InvalidArgument(fmt::format("x has {} values, but y has {}", v.size(), w.size()));
        return call.give_vector(v.binaryExpr(w, better));
    }
    const VectorMap v = not_empty(call, 1, "v");
    Index index = 0;
    const double value = kLargest ? v.maxCoeff<Eigen::PropagateNumbers>(&index)  // like fmax: nan only if all are
                                  : v.minCoeff<Eigen::PropagateNumbers>(&index);
    return call.give(value) + call.give_integer(index + 1);
}

/// A function of one number, applied to a number or to every element. `kLowest`: smallest argument it is defined for.
template <double (*kFunction)(double), bool kFromZero = false>
int apply(Call& call) {
    call.at_most(1);
    auto checked = [](double x) {
        if (kFromZero && x < 0)
            throw InvalidArgument(fmt::format("it is not defined for the negative number {:.6g}", x));
        return kFunction(x);
    };
    if (call.type(1) == LUA_TNUMBER) return call.give(checked(call.number(1, "x")));
    if (to_matrix(call.state(), 1) != nullptr) return call.give_matrix(call.matrix(1, "x").unaryExpr(checked));
    return call.give_vector(call.vector(1, "x").unaryExpr(checked));
}

int cumulative_sum(Call& call) {
    call.at_most(1);
    const VectorMap v = call.vector(1, "v");
    std::partial_sum(v.begin(), v.end(), push_vector(call.state(), v.size()).data());
    return 1;
}

int difference(Call& call) {
    call.at_most(1);
    const VectorMap v = not_empty(call, 1, "v");
    return call.give_vector(v.tail(v.size() - 1) - v.head(v.size() - 1));
}

int sort(Call& call) {
    call.at_most(1);
    const VectorMap v = call.vector(1, "v");
    std::vector<Index> order(static_cast<std::size_t>(v.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return v[a] < v[b] || (std::isnan(v[b]) && !std::isnan(v[a])); });
    NumericBlock &sorted = push_vector(call.state(), v.size()), &indices = push_vector(call.state(), v.size());
    for (Index i = 0; i < v.size(); ++i) {
        const Index index = order[static_cast<std::size_t>(i)];
        sorted.data()[i] = v[index];
        indices.data()[i] = static_cast<double>(index + 1);
    }
    return 2;
}

int polyval(Call& call) {
    call.at_most(2);
    const VectorMap p = not_empty(call, 1, "p");
    if (call.type(2) == LUA_TNUMBER) return call.give(evaluate(p, call.number(2, "x")));
    return call.give_vector(call.vector(2, "x").unaryExpr([&](double x) { return evaluate(p, x); }));
}

int interp1(Call& call) {
    call.at_most(4);
    const VectorMap x = call.vector(1, "x"), y = call.vector(2, "y");
    const Options options(call, 4, {"outside"});
    const auto outside = static_cast<Outside>(options.choice("outside", {"refuse", "hold"}, 0));
    if (call.type(3) != LUA_TNUMBER)
        return call.give_vector(interpolate_linearly(x, y, call.vector(3, "x_new"), outside));
    return call.give(interpolate_linearly(x, y, Vector::Constant(1, call.number(3, "x_new")), outside)[0]);
}

int solve(Call& call) {
    call.at_most(2);
    const MatrixMap A = call.matrix(1, "A"), b = call.matrix(2, "b");
    const bool vector = to_matrix(call.state(), 2) == nullptr;
    Matrix solution(A.cols(), b.cols());
    for (Index j = 0; j < b.cols(); ++j) solution.col(j) = solve_least_squares(A, b.col(j)).solution;
    return vector ? call.give_vector(solution.col(0)) : call.give_matrix(solution);
}

constexpr const char* kVectorsArea = "vectors";
constexpr std::array kVectorsFunctions = {
    FunctionEntry{"vector", kVectorsArea, "vector{x1, x2, ...} -> v",
                  "a column of numbers; vectors among the values are joined", guarded<make_vector>},
    FunctionEntry{"matrix", kVectorsArea, "matrix{{...}, {...}} or matrix{v1, v2} -> A",
                  "a matrix from its rows (tables) or its columns (vectors)", guarded<make_matrix>},
    FunctionEntry{"zeros", kVectorsArea, "zeros(n, m) -> v", "n zeros, or an n x m matrix of zeros", guarded<zeros>},
    FunctionEntry{"ones", kVectorsArea, "ones(n, m) -> v", "n ones, or an n x m matrix of ones", guarded<ones>},
    FunctionEntry{"eye", kVectorsArea, "eye(n) -> A", "the n x n identity matrix", guarded<eye>},
    FunctionEntry{"linspace", kVectorsArea, "linspace(first, last, n) -> v",
                  "n equally spaced values from first to last", guarded<linspace>},
    FunctionEntry{"range", kVectorsArea, "range(first, last) or range(first, step, last) -> v",
                  "values from first to last, step by step (MATLAB's first:step:last)", guarded<range>},
    FunctionEntry{"sum", kVectorsArea, "sum(v) -> x", "sum of the elements", guarded<sum>},
    FunctionEntry{"mean", kVectorsArea, "mean(v) -> x", "arithmetic mean", guarded<mean>},
    FunctionEntry{"std", kVectorsArea, "std(v) -> x", "standard deviation (divided by N - 1)",
                  guarded<standard_deviation>},
    FunctionEntry{"var", kVectorsArea, "var(v) -> x", "variance (divided by N - 1)", guarded<variance>},
    FunctionEntry{"min", kVectorsArea, "min(v) -> x, place; min(x, y) -> v",
                  "smallest element and its place; the smaller of two, element by element", guarded<extreme<false>>},
    FunctionEntry{"max", kVectorsArea, "max(v) -> x, place; max(x, y) -> v",
                  "largest element and its place; the larger of two, element by element", guarded<extreme<true>>},
    FunctionEntry{"abs", kVectorsArea, "abs(x) -> y", "absolute value of a number or of every element",
                  guarded<apply<std::fabs>>},
    FunctionEntry{"sqrt", kVectorsArea, "sqrt(x) -> y", "square root of a number or of every element",
                  guarded<apply<std::sqrt, true>>},
    FunctionEntry{"exp", kVectorsArea, "exp(x) -> y", "exponential of a number or of every element",
                  guarded<apply<std::exp>>},
    FunctionEntry{"log", kVectorsArea, "log(x) -> y", "natural logarithm of a number or of every element",
                  guarded<apply<std::log, true>>},
    FunctionEntry{"sin", kVectorsArea, "sin(x) -> y", "sine (radians) of a number or of every element",
                  guarded<apply<std::sin>>},
    FunctionEntry{"cos", kVectorsArea, "cos(x) -> y", "cosine (radians) of a number or of every element",
                  guarded<apply<std::cos>>},
    FunctionEntry{"cumsum", kVectorsArea, "cumsum(v) -> w", "running sum", guarded<cumulative_sum>},
    FunctionEntry{"diff", kVectorsArea, "diff(v) -> w", "differences of neighbours, one element fewer",
                  guarded<difference>},
    FunctionEntry{"dot", kVectorsArea, "dot(a, b) -> x", "scalar product", guarded<dot>},
    FunctionEntry{"norm", kVectorsArea, "norm(v) -> x", "Euclidean length", guarded<norm>},
    FunctionEntry{"sort", kVectorsArea, "sort(v) -> sorted, places", "ascending order, and where each element stood",
                  guarded<sort>},
    FunctionEntry{"polyval", kVectorsArea, "polyval(p, x) -> y", "value of a polynomial, highest power first",
                  guarded<polyval>},
    FunctionEntry{"interp1", kVectorsArea, "interp1(x, y, x_new, {outside =}) -> y_new", "linear interpolation",
                  guarded<interp1>},
    FunctionEntry{"solve", kVectorsArea, "solve(A, b) -> x",
                  "A x = b; the least-squares solution when A has more rows than columns (MATLAB's A\\b)",
                  guarded<solve>},
};

}  // namespace

FunctionEntries vector_functions() {
    return kVectorsFunctions;
}

}  // namespace dynlab::inline scripting
