#include <algorithm>

#include "scripting/bind/bindings.h"
#include "scripting/objects/traced_value.h"

namespace dynlab::inline scripting {
namespace {

/// One where the relation holds between values that are not known yet, zero elsewhere.
template <class Relation>
int compare_traced(const Call& call, const std::shared_ptr<Trace>& trace) {
    const auto x = traced_node(call.state(), 1, trace), y = traced_node(call.state(), 2, trace);
    const bool above = Relation()(1., 0.), with_equal = Relation()(0., 0.), below = Relation()(0., 1.);
    if (!x || !y || above == below)
        throw InvalidArgument(
            "symbolic values can be compared only with gt, lt, ge and le, and only with a number or another symbolic "
            "value");
    ExpressionTape& tape = trace->tape;
    const bool turned = above == with_equal;  // x >= y is what y - x > 0 leaves
    const auto difference = tape.apply(Operation::kSubtract, turned ? *y : *x, turned ? *x : *y);
    return give_traced(call, trace,
                       tape.apply(Operation::kWhere, difference, tape.constant(with_equal ? 0 : 1),
                                  tape.constant(with_equal ? 1 : 0)));
}

/// One truth value per element of v: whether the relation to x holds (x is a number, or a vector of the same length).
template <class Relation>
int compare_elements(Call& call) {
    call.at_most(2);
    if (const auto trace = trace_among(call)) return compare_traced<Relation>(call, trace);
    const VectorMap v = call.vector(1, "v");
    const bool number = call.type(2) == LUA_TNUMBER;
    const VectorMap x = number ? v : call.vector(2, "x");
    if (x.size() != v.size())
        throw InvalidArgument("v and x must have the same number of elements, but v has {} and x has {}",
                              plural(v.size(), "{} value", "{} values"), x.size());
    const double bound = number ? call.number(2, "x") : 0;
    MaskBlock& mask = push_mask(call.state(), v.size());
    for (Index i = 0; i < v.size(); ++i) mask.data()[i] = Relation()(v[i], number ? bound : x[i]);
    return 1;
}

int find(Call& call) {
    call.at_most(1);
    MaskBlock* mask = call.given(1) ? to_mask(call.state(), 1) : nullptr;
    if (mask == nullptr) wrong_argument(call.state(), 1, "mask", Message("a mask returned by gt, lt, ge, le or eq"));
    double* next = push_vector(call.state(), std::count(mask->data(), mask->data() + mask->size, true)).data();
    for (Index i = 0; i < mask->size; ++i)
        if (mask->data()[i]) *next++ = static_cast<double>(i + 1);
    return 1;
}

constexpr FunctionEntry kComparisonsFunctions[] = {
    {"gt", "vectors", "gt(v, x) -> mask", "Find elements greater than x",
     guarded<compare_elements<std::greater<double>>>},
    {"lt", "vectors", "lt(v, x) -> mask", "Find elements less than x", guarded<compare_elements<std::less<double>>>},
    {"ge", "vectors", "ge(v, x) -> mask", "Find elements greater than or equal to x",
     guarded<compare_elements<std::greater_equal<double>>>},
    {"le", "vectors", "le(v, x) -> mask", "Find elements less than or equal to x",
     guarded<compare_elements<std::less_equal<double>>>},
    {"eq", "vectors", "eq(v, x) -> mask", "Find elements equal to x", guarded<compare_elements<std::equal_to<double>>>},
    {"find", "vectors", "find(mask) -> places", "Find the positions of the true elements of a mask", guarded<find>},
};

}  // namespace

FunctionEntries vector_comparisons() {
    return kComparisonsFunctions;
}

}  // namespace dynlab::inline scripting
