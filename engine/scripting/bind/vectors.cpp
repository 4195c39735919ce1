#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "numerics/linalg/polynomial.h"
#include "numerics/signals/interpolation.h"
#include "numerics/signals/unwrap.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/userdata.h"
#include "scripting/runtime/option_entry.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kOutsideModes = {"refuse", "hold"};
constexpr std::array kInterp1Options = {OptionEntry{
    "outside",
    ValueKind::kChoice,
    about(
        "values beyond the first and the last point: an error (\"refuse\"), or the values of these points (\"hold\")"),
    {.initial = "\"refuse\"", .choices = kOutsideModes}}};
constexpr OptionTable kInterp1Tables[] = {kInterp1Options};

constexpr std::array kMakeVectorArguments = {
    ArgumentEntry{"x1, x2, ...", ValueKind::kVector, about("numbers or vectors, in braces")}};
constexpr std::array kMakeMatrixArguments = {
    ArgumentEntry{"{...}, {...}", ValueKind::kVector,
                  about("rows of the matrix: tables of numbers, all of the same length")},
    ArgumentEntry{"v1, v2", ValueKind::kVector, about("columns of the matrix: vectors of equal length")}};
constexpr std::array kZerosArguments = {
    ArgumentEntry{"n", ValueKind::kCount, about("number of values, or number of rows if you specify m")},
    ArgumentEntry{"m", ValueKind::kCount, about("number of columns; by default 1")}};
constexpr std::array kEyeArguments = {ArgumentEntry{"n", ValueKind::kCount, about("number of rows and of columns")}};
constexpr std::array kLinspaceArguments = {
    ArgumentEntry{"first", ValueKind::kNumber, about("first value")},
    ArgumentEntry{"last", ValueKind::kNumber, about("last value, which can be smaller than the first value")},
    ArgumentEntry{"n", ValueKind::kCount, about("number of values; by default 100")}};
constexpr std::array kLogspaceArguments = {
    ArgumentEntry{"first", ValueKind::kNumber, about("exponent of ten of the first value")},
    ArgumentEntry{"last", ValueKind::kNumber, about("exponent of ten of the last value")},
    ArgumentEntry{"n", ValueKind::kCount, about("number of values; by default 50")}};
constexpr std::array kRangeArguments = {
    ArgumentEntry{"first", ValueKind::kNumber, about("first value")},
    ArgumentEntry{"last", ValueKind::kNumber, about("last value, included if the steps reach it exactly")},
    ArgumentEntry{"step", ValueKind::kNumber, about("step between values; by default 1. A negative step counts down")}};
constexpr std::array kOneVectorArguments = {
    ArgumentEntry{"v", ValueKind::kVector, about("vector, or a table of numbers such as {1, 2, 3}")}};
constexpr std::array kUnwrapArguments = {
    ArgumentEntry{"x", ValueKind::kVector, about("vector of angles with jumps of one full turn")},
    ArgumentEntry{"period", ValueKind::kNumber, about("one full turn: 360 for degrees; by default 2*pi")}};
constexpr std::array kDotArguments = {
    ArgumentEntry{"a", ValueKind::kVector, about("vector, or a table of numbers")},
    ArgumentEntry{"b", ValueKind::kVector, about("vector of the same size, or a table of numbers")}};
constexpr std::array kPolyvalArguments = {
    ArgumentEntry{"p", ValueKind::kVector, about("vector of coefficients, at least one, highest power first")},
    ArgumentEntry{"x", ValueKind::kVector, about("number or vector at which the polynomial is evaluated")}};
constexpr std::array kInterp1Arguments = {
    ArgumentEntry{"x", ValueKind::kVector, about("vector of at least two increasing values")},
    ArgumentEntry{"y", ValueKind::kVector, about("vector of the same size, with the values at x")},
    ArgumentEntry{"x_new", ValueKind::kVector, about("number or vector of query points")}};

int make_vector(Call& call) {
    if (call.count() != 1 || (to_vector(call.state(), 1) == nullptr && call.type(1) != LUA_TTABLE))
        throw InvalidArgument("write a vector with braces: vector{1, 2, 3}");
    const VectorMap values = call.vector(1, "values");
    return call.give_vector(values);
}

int make_matrix(Call& call) {
    if (call.count() != 1 || call.type(1) != LUA_TTABLE)
        throw InvalidArgument("write a matrix with braces: matrix{{1, 2}, {3, 4}} (rows) or matrix{v1, v2} (columns)");
    make_matrix_of_table(call.state(), 1, argument_label(1, Message("rows or columns")));
    return 1;
}

/// Pushes n values, or an n x m matrix when a second size other than 1 is given; returns the room for them.
Eigen::Map<Vector> new_block(Call& call, int first) {
    const Index rows = call.size(first, "n"), columns = call.given(first + 1) ? call.size(first + 1, "m") : 1;
    NumericBlock& block = columns == 1 ? push_vector(call.state(), rows) : push_matrix(call.state(), rows, columns);
    return block.vector();
}

template <int kValue>
int constant(Call& call) {
    call.at_most(2);
    new_block(call, 1).setConstant(kValue);
    return 1;
}
int eye(Call& call) {
    call.at_most(1);
    const Index n = call.size(1, "n");
    push_matrix(call.state(), n, n).matrix().setIdentity();
    return 1;
}
/// Pushes values with equal steps.
Eigen::Map<Vector> spaced(Call& call, Index usual_count) {
    call.at_most(3);
    const double first = call.number(1, "first"), last = call.number(2, "last");
    if (!std::isfinite(first) || !std::isfinite(last))
        throw InvalidArgument("first and last must be finite numbers, but they are {} and {}", first, last);
    const Index count = call.given(3) ? call.size(3, "n") : usual_count;
    Eigen::Map<Vector> values = push_vector(call.state(), count).vector();
    values = Vector::LinSpaced(count, first, last);
    return values;
}
int linspace(Call& call) {
    spaced(call, 100);
    return 1;
}
int logspace(Call& call) {
    for (double& x : spaced(call, 50)) x = std::pow(10, x);
    return 1;
}

int range(Call& call) {
    call.at_most(3);
    if (call.given(1) && !call.given(2))
        throw InvalidArgument("argument 2 (last) is missing; write range(first, last), such as range(1, 3)");
    const double first = call.number(1, "first"), last = call.number(call.given(3) ? 3 : 2, "last");
    const double step = call.given(3) ? call.number(2, "step") : 1;
    if (step == 0 || !std::isfinite(step))
        throw InvalidArgument("the step must be finite and not zero, but it is {}", step);
    const double count = std::floor((last - first) / step * (1 + 1e-15) + 1e-10) + 1;
    if (!std::isfinite(count))
        throw InvalidArgument("first and last must be finite numbers, but they are {} and {}", first, last);
    NumericBlock& block = push_vector(call.state(), index_of_whole(std::max(count, 0.0)));
    for (Index k = 0; k < block.rows; ++k) block.data()[k] = first + static_cast<double>(k) * step;
    return 1;
}

int norm(Call& call) {
    call.at_most(1);
    return call.give(call.vector(1, "v").norm());
}

int dot(Call& call) {
    call.at_most(2);
    const VectorMap a = call.vector(1, "a"), b = call.vector(2, "b");
    if (a.size() != b.size())
        throw InvalidArgument("a and b must have the same number of elements, but a has {} and b has {}",
                              plural(a.size(), "{} value", "{} values"), b.size());
    return call.give(a.dot(b));
}

VectorMap not_empty(Call& call, int index, ArgumentName what) {
    const VectorMap v = call.vector(index, what);
    if (v.size() == 0)
        throw InvalidArgument("{} must have at least one element, but it is empty", argument_label(index, what));
    return v;
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

int unwrap_angle(Call& call) {
    call.at_most(2);
    const VectorMap x = not_empty(call, 1, "x");
    return call.give_vector(unwrap(x, call.given(2) ? call.number(2, "period") : 2 * std::numbers::pi));
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
    const Options options(call, 4, kInterp1Tables);
    const auto outside =
        options.has("outside") ? static_cast<Outside>(options.choice(kInterp1Options[0])) : Outside::kRefuse;
    if (call.type(3) != LUA_TNUMBER)
        return call.give_vector(interpolate_linearly(x, y, call.vector(3, "x_new"), outside));
    return call.give(interpolate_linearly(x, y, Vector::Constant(1, call.number(3, "x_new")), outside)[0]);
}

constexpr FunctionEntry kVectorsFunctions[] = {
    {"vector", "vectors", "vector{x1, x2, ...} -> v", "Create a vector from numbers", guarded<make_vector>, kNoOptions,
     kMakeVectorArguments},
    {"matrix", "vectors", "matrix{{...}, {...}} or matrix{v1, v2} -> A",
     "Create a matrix from rows (tables) or columns (vectors)", guarded<make_matrix>, kNoOptions, kMakeMatrixArguments},
    {"zeros", "vectors", "zeros(n, m) -> v", "Create n zeros, or an n x m matrix of zeros", guarded<constant<0>>,
     kNoOptions, kZerosArguments},
    {"ones", "vectors", "ones(n, m) -> v", "Create n ones, or an n x m matrix of ones", guarded<constant<1>>,
     kNoOptions, kZerosArguments},
    {"eye", "vectors", "eye(n) -> A", "Create the n x n identity matrix", guarded<eye>, kNoOptions, kEyeArguments},
    {"linspace", "vectors", "linspace(first, last, n) -> v", "Create n equally spaced values from first to last",
     guarded<linspace>, kNoOptions, kLinspaceArguments},
    {"logspace", "vectors", "logspace(first, last, n) -> v",
     "Create n logarithmically spaced values from 10^first to 10^last", guarded<logspace>, kNoOptions,
     kLogspaceArguments},
    {"range", "vectors", "range(first, last) or range(first, step, last) -> v",
     "Create values from first to last with a step (MATLAB's first:step:last)", guarded<range>, kNoOptions,
     kRangeArguments},
    {"cumsum", "vectors", "cumsum(v) -> w", "Cumulative sum", guarded<cumulative_sum>, kNoOptions, kOneVectorArguments},
    {"diff", "vectors", "diff(v) -> w", "Differences between adjacent elements", guarded<difference>, kNoOptions,
     kOneVectorArguments},
    {"unwrap", "vectors", "unwrap(x, period) -> y", "Remove jumps of full turns from an angle signal",
     guarded<unwrap_angle>, kNoOptions, kUnwrapArguments},
    {"dot", "vectors", "dot(a, b) -> x", "Scalar product", guarded<dot>, kNoOptions, kDotArguments},
    {"norm", "vectors", "norm(v) -> x", "Euclidean norm of a vector", guarded<norm>, kNoOptions, kOneVectorArguments},
    {"sort", "vectors", "sort(v) -> sorted, places", "Sort in ascending order, and return the original positions",
     guarded<sort>, kNoOptions, kOneVectorArguments},
    {"polyval", "vectors", "polyval(p, x) -> y", "Evaluate a polynomial from its coefficients, highest power first",
     guarded<polyval>, kNoOptions, kPolyvalArguments},
    {"interp1", "vectors", "interp1(x, y, x_new, {options}) -> y_new", "Linear interpolation", guarded<interp1>,
     kInterp1Tables, kInterp1Arguments},
};

}  // namespace

FunctionEntries vector_functions() {
    return kVectorsFunctions;
}

}  // namespace dynlab::inline scripting
