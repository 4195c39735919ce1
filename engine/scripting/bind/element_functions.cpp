#include <array>
#include <cmath>
#include <optional>

#include "scripting/bind/bindings.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

enum class Domain { kAll, kFromZero };

/// A function of one number, applied to a number or to every element.
template <double (*kFunction)(double), Domain kDomain = Domain::kAll>
int apply(Call& call) {
    call.at_most(1);
    const auto checked = [](double x) {
        if (kDomain == Domain::kFromZero && x < 0)
            throw InvalidArgument(fmt::format("it is not defined for the negative number {:.6g}", x));
        return kFunction(x);
    };
    if (call.type(1) == LUA_TNUMBER) return call.give(checked(call.number(1, "x")));
    if (to_matrix(call.state(), 1) != nullptr) return call.give_matrix(call.matrix(1, "x").unaryExpr(checked));
    return call.give_vector(call.vector(1, "x").unaryExpr(checked));
}

int absolute(Call& call) {
    if (const Complex* z = to_object<Complex>(call.state(), 1)) return call.give(std::abs(*z));
    if (const ComplexVector* z = to_object<ComplexVector>(call.state(), 1)) return call.give_vector(z->cwiseAbs());
    return apply<std::fabs>(call);
}

/// Td of a model -Td s.
std::optional<double> delay_of(const Model& model) {
    const TransferFunction& G = model.G;
    if (!model.single_channel()) return std::nullopt;
    if (!G.continuous() || G.den().size() != 1 || G.num().size() != 2 || G.num()[1] != 0 || G.delay() != 0)
        return std::nullopt;
    return -G.num()[0] / G.den()[0];
}

int exponential(Call& call) {
    const Model* model = to_object<Model>(call.state(), 1);
    if (model == nullptr) return apply<std::exp>(call);
    const std::optional<double> delay = delay_of(*model);
    if (!delay || *delay < 0)
        throw InvalidArgument(
            "of models only a delay is there: exp(-Td*s) with s = tf(\"s\") and Td from 0 on, or "
            "{IODelay = Td}");
    const Vector one = Vector::Ones(1);
    return give_model(call, TransferFunction(one, one, 0, *delay));
}

double sign(double x) {
    return x > 0 ? 1 : x < 0 ? -1 : x;
}

constexpr const char* kElementArea = "vectors";
constexpr std::array kElementFunctions = {
    FunctionEntry{"abs", kElementArea, "abs(x) -> y", "absolute value of a number or of every element",
                  guarded<absolute>},
    FunctionEntry{"sign", kElementArea, "sign(x) -> y", "-1, 0 or 1, of a number or of every element",
                  guarded<apply<sign>>},
    FunctionEntry{"round", kElementArea, "round(x) -> y", "the nearest whole number, halves away from zero",
                  guarded<apply<std::round>>},
    FunctionEntry{"floor", kElementArea, "floor(x) -> y", "the whole number at or below", guarded<apply<std::floor>>},
    FunctionEntry{"ceil", kElementArea, "ceil(x) -> y", "the whole number at or above", guarded<apply<std::ceil>>},
    FunctionEntry{"sqrt", kElementArea, "sqrt(x) -> y", "square root of a number or of every element",
                  guarded<apply<std::sqrt, Domain::kFromZero>>},
    FunctionEntry{"exp", kElementArea, "exp(x) -> y; exp(-Td*s) -> G",
                  "exponential of a number or of every element; a delay", guarded<exponential>},
    FunctionEntry{"log", kElementArea, "log(x) -> y", "natural logarithm of a number or of every element",
                  guarded<apply<std::log, Domain::kFromZero>>},
    FunctionEntry{"log10", kElementArea, "log10(x) -> y", "logarithm to base 10 of a number or of every element",
                  guarded<apply<std::log10, Domain::kFromZero>>},
    FunctionEntry{"sin", kElementArea, "sin(x) -> y", "sine (radians) of a number or of every element",
                  guarded<apply<std::sin>>},
    FunctionEntry{"cos", kElementArea, "cos(x) -> y", "cosine (radians) of a number or of every element",
                  guarded<apply<std::cos>>},
};

}  // namespace

FunctionEntries element_functions() {
    return kElementFunctions;
}

}  // namespace dynlab::inline scripting
