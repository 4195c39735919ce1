#include <algorithm>
#include <cmath>
#include <vector>

#include "numerics/signals/robust_statistics.h"
#include "scripting/bind/bindings.h"
#include "scripting/objects/traced_value.h"

namespace dynlab::inline scripting {
namespace {

void need_values(Index count, Index minimum) {
    if (count == 0) throw InvalidArgument("{} must have at least one element, but it is empty", argument_label(1, "v"));
    if (count < minimum)
        throw InvalidArgument("a standard deviation or a variance needs at least two values, but only one was given");
}

/// A number for a vector, a vector with one number for each column of a matrix. Every column is summed in the same
/// order as a vector.
template <double (*kMeasure)(const VectorView&), Index kMin>
int measure_columns(Call& call) {
    call.at_most(1);
    if (to_matrix(call.state(), 1) == nullptr) {
        const VectorMap v = call.vector(1, "v");
        need_values(kMin == 0 ? 1 : v.size(), kMin);
        return call.give(kMeasure(v));
    }
    const MatrixMap A = call.matrix(1, "A");
    need_values(kMin == 0 ? 1 : A.rows(), kMin);
    Vector measures(A.cols());
    for (Index j = 0; j < A.cols(); ++j) measures[j] = kMeasure(A.col(j));
    return call.give_vector(measures);
}

double sum_of(const VectorView& v) {
    return v.sum();
}
double mean_of(const VectorView& v) {
    return v.mean();
}
double variance_of(const VectorView& v) {
    return (v.array() - v.mean()).square().sum() / static_cast<double>(v.size() - 1);
}
double deviation_of(const VectorView& v) {
    return std::sqrt(variance_of(v));
}
double median_of(const VectorView& v) {
    return v.hasNaN() ? std::nan("") : median(v);
}

int sum(Call& call) {
    const MaskBlock* mask = call.given(1) ? to_mask(call.state(), 1) : nullptr;
    if (mask == nullptr) return measure_columns<sum_of, 0>(call);
    bool* values = to_mask(call.state(), 1)->data();
    return call.give_integer(std::count(values, values + mask->size, true));
}

/// Like fmax and fmin, NaN only where all are; the first of several equal ones.
template <bool kMaxValue>
double extreme_of(const VectorView& v, Index& place) {
    return kMaxValue ? v.maxCoeff<Eigen::PropagateNumbers>(&place) : v.minCoeff<Eigen::PropagateNumbers>(&place);
}

/// max(v) gives the value and its place, max(A) those of every column; max(x, y) the larger one, element by element.
template <bool kMaxValue>
int extreme(Call& call) {
    call.at_most(2);
    if (const auto trace = trace_among(call))
        return give_traced_operation(call, trace, kMaxValue ? Operation::kMaximum : Operation::kMinimum, 2);
    const auto better = [](double x, double y) { return kMaxValue ? std::fmax(x, y) : std::fmin(x, y); };
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
            throw InvalidArgument("x and y must have the same number of elements, but x has {} and y has {}",
                                  plural(v.size(), "{} value", "{} values"), w.size());
        return call.give_vector(v.binaryExpr(w, better));
    }
    if (to_matrix(call.state(), 1) != nullptr) {
        const MatrixMap A = call.matrix(1, "A");
        need_values(A.rows(), 1);
        Vector values(A.cols()), places(A.cols());
        for (Index j = 0; j < A.cols(); ++j) {
            Index place = 0;
            values[j] = extreme_of<kMaxValue>(A.col(j), place);
            places[j] = static_cast<double>(place + 1);
        }
        return call.give_vector(values) + call.give_vector(places);
    }
    const VectorMap v = call.vector(1, "v");
    need_values(v.size(), 1);
    Index place = 0;
    const double value = extreme_of<kMaxValue>(v, place);
    return call.give(value) + call.give_integer(place + 1);
}

constexpr FunctionEntry kStatisticsFunctions[] = {
    {"sum", "vectors", "sum(v) -> x; sum(A) -> w", "Sum of the elements of a vector, or of each column of a matrix",
     guarded<sum>},
    {"mean", "vectors", "mean(v) -> x; mean(A) -> w", "Mean of the elements of a vector, or of each column of a matrix",
     guarded<measure_columns<mean_of, 1>>},
    {"median", "vectors", "median(v) -> x; median(A) -> w",
     "Median of the elements of a vector, or of each column of a matrix", guarded<measure_columns<median_of, 1>>},
    {"std", "vectors", "std(v) -> x; std(A) -> w",
     "Standard deviation of a vector, or of each column of a matrix (divisor N - 1)",
     guarded<measure_columns<deviation_of, 2>>},
    {"var", "vectors", "var(v) -> x; var(A) -> w",
     "Variance of a vector, or of each column of a matrix (divisor N - 1)", guarded<measure_columns<variance_of, 2>>},
    {"min", "vectors", "min(v) -> smallest, place; min(x, y) -> w",
     "Smallest element and its position, or the element-wise minimum", guarded<extreme<false>>},
    {"max", "vectors", "max(v) -> largest, place; max(x, y) -> w",
     "Largest element and its position, or the element-wise maximum", guarded<extreme<true>>},
};

}  // namespace

FunctionEntries column_statistics() {
    return kStatisticsFunctions;
}

}  // namespace dynlab::inline scripting
