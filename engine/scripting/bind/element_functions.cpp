#include <cmath>
#include <optional>

#include "scripting/bind/bindings.h"
#include "scripting/objects/model.h"
#include "scripting/objects/traced_value.h"

namespace dynlab::inline scripting {
namespace {

enum class Domain { kAll, kFromZero };

/// Of functions that values which are not known yet cannot go through.
constexpr Operation kNotTraced = Operation::kConstant;

/// A function of one number, applied to a number or to every element; of a traced value its expression.
template <double (*kFunction)(double), Operation kTraced = kNotTraced, Domain kDomain = Domain::kAll>
int apply(Call& call) {
    call.at_most(1);
    if (const auto trace = trace_among(call)) {
        if (kTraced == kNotTraced)
            throw InvalidArgument("{} is not supported for symbolic values", call.function_name());
        return give_traced_operation(call, trace, kTraced, 1);
    }
    const auto checked = [](double x) {
        if (kDomain == Domain::kFromZero && x < 0)
            throw InvalidArgument("the function is undefined for the negative number {}", significant(x, 6));
        return kFunction(x);
    };
    if (call.type(1) == LUA_TNUMBER) return call.give(checked(call.number(1, "x")));
    if (to_matrix(call.state(), 1) != nullptr) return call.give_matrix(call.matrix(1, "x").unaryExpr(checked));
    return call.give_vector(call.vector(1, "x").unaryExpr(checked));
}

int absolute(Call& call) {
    if (const Complex* z = to_object<Complex>(call.state(), 1)) return call.give(std::abs(*z));
    if (const ComplexVector* z = to_object<ComplexVector>(call.state(), 1)) return call.give_vector(z->cwiseAbs());
    return apply<std::fabs, Operation::kAbs>(call);
}

/// Td of a model -Td s; 0 of the zero model, which is -0 s.
std::optional<double> delay_of(const Model& model) {
    const TransferFunction& G = model.G;
    if (!model.single_channel()) return std::nullopt;
    if (!G.continuous() || G.den().size() != 1 || G.delay() != 0) return std::nullopt;
    if (G.num().isZero(0)) return 0.0;
    if (G.num().size() != 2 || G.num()[1] != 0) return std::nullopt;
    return -G.num()[0] / G.den()[0];
}

int exponential(Call& call) {
    const Model* model = to_object<Model>(call.state(), 1);
    if (model == nullptr) return apply<std::exp, Operation::kExp>(call);
    const std::optional<double> delay = delay_of(*model);
    if (!delay || *delay < 0)
        throw InvalidArgument(
            "for models, exp supports only a delay: exp(-Td*s) with s = tf(\"s\") and a nonnegative Td, or {IODelay = "
            "Td}");
    const Vector one = Vector::Ones(1);
    return give_model(call, TransferFunction(one, one, 0, *delay));
}

double sign(double x) {
    return x > 0 ? 1 : x < 0 ? -1 : x;
}

/// Numbers and vectors of one length, element by element.
double element_of(const Call& call, int index, Index i, Index size) {
    if (call.type(index) == LUA_TNUMBER) return call.number(index, "value");
    const VectorMap v = call.vector(index, index == 2 ? "a" : "b");
    if (v.size() != size)
        throw InvalidArgument("all vectors must have the same number of elements, but c has {} and {} has {}",
                              plural(size, "{} value", "{} values"), index == 2 ? "a" : "b", v.size());
    return v[i];
}

/// where(c, a, b): a where c is positive, b elsewhere; c may be a mask.
int choose(Call& call) {
    call.at_most(3);
    if (const auto trace = trace_among(call)) return give_traced_operation(call, trace, Operation::kWhere, 3);
    if (MaskBlock* mask = call.given(1) ? to_mask(call.state(), 1) : nullptr) {
        Vector chosen(mask->size);
        for (Index i = 0; i < chosen.size(); ++i) chosen[i] = element_of(call, mask->data()[i] ? 2 : 3, i, mask->size);
        return call.give_vector(chosen);
    }
    if (call.type(1) == LUA_TNUMBER)
        return call.give(value_of(Operation::kWhere, call.number(1, "c"), call.number(2, "a"), call.number(3, "b")));
    const Vector c = call.vector(1, "c");
    Vector chosen(c.size());
    for (Index i = 0; i < c.size(); ++i) chosen[i] = element_of(call, c[i] > 0 ? 2 : 3, i, c.size());
    return call.give_vector(chosen);
}

constexpr FunctionEntry kElementFunctions[] = {
    {"abs", "vectors", "abs(x) -> y", "Absolute value", guarded<absolute>},
    {"sign", "vectors", "sign(x) -> y", "Sign: -1, 0 or 1", guarded<apply<sign, Operation::kSign>>},
    {"round", "vectors", "round(x) -> y", "Round to the nearest whole number; halves are rounded away from zero",
     guarded<apply<std::round>>},
    {"floor", "vectors", "floor(x) -> y", "Round down to a whole number", guarded<apply<std::floor>>},
    {"ceil", "vectors", "ceil(x) -> y", "Round up to a whole number", guarded<apply<std::ceil>>},
    {"sqrt", "vectors", "sqrt(x) -> y", "Square root", guarded<apply<std::sqrt, Operation::kSqrt, Domain::kFromZero>>},
    {"exp", "vectors", "exp(x) -> y; exp(-Td*s) -> G", "Exponential function, or a time delay in a model",
     guarded<exponential>},
    {"log", "vectors", "log(x) -> y", "Natural logarithm",
     guarded<apply<std::log, Operation::kLog, Domain::kFromZero>>},
    {"log10", "vectors", "log10(x) -> y", "Logarithm to base 10",
     guarded<apply<std::log10, kNotTraced, Domain::kFromZero>>},
    {"sin", "vectors", "sin(x) -> y", "Sine (radians)", guarded<apply<std::sin, Operation::kSin>>},
    {"cos", "vectors", "cos(x) -> y", "Cosine (radians)", guarded<apply<std::cos, Operation::kCos>>},
    {"tan", "vectors", "tan(x) -> y", "Tangent (radians)", guarded<apply<std::tan, Operation::kTan>>},
    {"atan", "vectors", "atan(x) -> y", "Inverse tangent (radians)", guarded<apply<std::atan, Operation::kArcTangent>>},
    {"tanh", "vectors", "tanh(x) -> y", "Hyperbolic tangent", guarded<apply<std::tanh, Operation::kTanh>>},
    {"where", "vectors", "where(c, a, b) -> y", "Select between two values, element-wise for a vector or mask",
     guarded<choose>},
};

}  // namespace

FunctionEntries element_functions() {
    return kElementFunctions;
}

}  // namespace dynlab::inline scripting
