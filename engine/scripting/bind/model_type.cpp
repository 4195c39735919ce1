#include <array>
#include <cmath>

#include "scripting/objects/model.h"
#include "scripting/objects/present.h"
#include "scripting/objects/text_form.h"

namespace dynlab::inline scripting {
namespace {

const Model& model_self(Call& call) {
    return object_argument<Model>(call, 1, "G");
}

const Estimate& estimate_of_self(Call& call) {
    const Model& model = model_self(call);
    if (!model.estimate)
        throw InvalidArgument("this model was written down, not estimated, so it has no standard errors and no report");
    return *model.estimate;
}

/// The transfer function of a model with one channel.
const TransferFunction& only_channel(Call& call) {
    const Model& model = model_self(call);
    if (model.single_channel()) return model.G;
    throw InvalidArgument("this field is one channel's, and the model has several channels: " + channels_hint(model));
}

int field_num(Call& call) {
    return call.give_vector(only_channel(call).num());
}
int field_den(Call& call) {
    return call.give_vector(only_channel(call).den());
}
int field_delay(Call& call) {
    return call.give(only_channel(call).delay());
}

const PolynomialModel& polynomials(Call& call) {
    const Model& model = model_self(call);
    if (model.polynomial) return *model.polynomial;
    throw InvalidArgument(
        "only models of difference equations, as arx, oe and sriv give them, have this polynomial; lssvf and ivsvf "
        "give A and B, srivc and its like B and F, rivc gives C and D too, n4sid matrices A, B, C and D");
}
bool is_carx(Call& call) {
    const Model& model = model_self(call);
    return model.estimate && model.estimate->carx;
}
const NoiseModel* noise_of(Call& call) {
    const Model& model = model_self(call);
    return model.estimate ? model.estimate->noise.get() : nullptr;
}
/// An estimate y = B/F u of one continuous-time channel, whose num is B and whose den is F.
bool has_form_of_output_error(const Model& model) {
    return model.estimate && !model.estimate->carx && !model.polynomial && !model.system && !model.process &&
           model.single_channel() && model.G.continuous();
}
template <Vector PolynomialModel::*kPolynomial>
int field_polynomial(Call& call) {
    if (kPolynomial == &PolynomialModel::A && is_carx(call)) return field_den(call);
    return call.give_vector(polynomials(call).*kPolynomial);
}
/// A vector, or a table of one vector for each of several inputs.
template <std::vector<Vector> PolynomialModel::*kPolynomials>
int field_input_polynomials(Call& call) {
    if (kPolynomials == &PolynomialModel::B && is_carx(call)) return field_num(call);
    if (has_form_of_output_error(model_self(call)))
        return kPolynomials == &PolynomialModel::B ? field_num(call) : field_den(call);
    const std::vector<Vector>& list = polynomials(call).*kPolynomials;
    if (list.size() == 1) return call.give_vector(list.front());
    lua_createtable(call.state(), static_cast<int>(list.size()), 0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        call.give_vector(list[i]);
        lua_rawseti(call.state(), -2, static_cast<lua_Integer>(i + 1));
    }
    return 1;
}

/// A list of models, one per input.
void push_channels(const Call& call, const TransferFunction* first, std::size_t inputs) {
    lua_createtable(call.state(), static_cast<int>(inputs), 0);
    for (std::size_t i = 0; i < inputs; ++i) {
        give_model(call, first[i]);
        lua_rawseti(call.state(), -2, static_cast<lua_Integer>(i + 1));
    }
}
/// The transfer function from each input; with several outputs such a list for each.
int field_channels(Call& call) {
    const Model& model = model_self(call);
    const std::vector<TransferFunction> channels = channels_of(model);
    if (model.outputs == 1) {
        push_channels(call, channels.data(), model.inputs());
        return 1;
    }
    lua_createtable(call.state(), static_cast<int>(model.outputs), 0);
    for (std::size_t i = 0; i < model.outputs; ++i) {
        push_channels(call, channels.data() + i * model.inputs(), model.inputs());
        lua_rawseti(call.state(), -2, static_cast<lua_Integer>(i + 1));
    }
    return 1;
}
int field_sampling_time(Call& call) {
    return call.give(model_self(call).G.Ts());
}
int field_param(Call& call) {
    return call.give_vector(parameters_of(model_self(call)).values);
}
int field_std(Call& call) {
    return call.give_vector(estimate_of_self(call).std);
}
int field_covariance(Call& call) {
    return call.give_matrix(estimate_of_self(call).covariance);
}

int field_noise_variance(Call& call) {
    const Estimate& estimate = estimate_of_self(call);
    for (const auto& [name, value] : estimate.numbers)
        if (name == "noise_variance") return call.give(value);
    throw InvalidArgument(fmt::format("{} tells no variance of the noise", estimate.method));
}

const Assessment& assessment_of(Call& call) {
    const Estimate& estimate = estimate_of_self(call);
    if (estimate.assessment) return *estimate.assessment;
    throw InvalidArgument(fmt::format("{} gives no robust standard errors", estimate.method));
}
int field_robust_std(Call& call) {
    return call.give_vector(assessment_of(call).std);
}
int field_robust_covariance(Call& call) {
    return call.give_matrix(assessment_of(call).covariance);
}

int field_names(Call& call) {
    lua_newtable(call.state());
    lua_Integer index = 0;
    for (const std::string& name : parameters_of(model_self(call)).names) {
        lua_pushstring(call.state(), name.c_str());
        lua_rawseti(call.state(), -2, ++index);
    }
    return 1;
}

/// G.report: a plain table.
int field_report(Call& call) {
    const Estimate& estimate = estimate_of_self(call);
    lua_State* L = call.state();
    lua_newtable(L);
    lua_pushstring(L, estimate.method.c_str());
    lua_setfield(L, -2, "method");
    lua_pushstring(L, estimate.message.c_str());
    lua_setfield(L, -2, "message");
    lua_pushboolean(L, estimate.converged);
    lua_setfield(L, -2, "converged");
    for (const auto& [name, value] : estimate.numbers) {
        lua_pushnumber(L, value);
        lua_setfield(L, -2, name.c_str());
    }
    for (const auto& [name, values] : estimate.vectors) {
        call.give_vector(values);
        lua_setfield(L, -2, name.c_str());
    }
    for (const auto& [name, values] : estimate.matrices) {
        call.give_matrix(values);
        lua_setfield(L, -2, name.c_str());
    }
    if (estimate.assessment) {
        lua_pushboolean(L, estimate.assessment->white);
        lua_setfield(L, -2, "white");
        lua_pushstring(L, estimate.assessment->verdict.c_str());
        lua_setfield(L, -2, "residual_verdict");
    }
    lua_createtable(L, static_cast<int>(estimate.warnings.size()), 0);
    for (std::size_t i = 0; i < estimate.warnings.size(); ++i) {
        lua_pushstring(L, estimate.warnings[i].c_str());
        lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
    lua_setfield(L, -2, "warnings");
    return 1;
}

/// G.Kp, G.Tp1, G.K, ...: a parameter by its name, which is the field's own.
int field_parameter(Call& call) {
    const std::string name = call.function_name();
    const ModelParameters parameters = parameters_of(model_self(call));
    for (std::size_t i = 0; i < parameters.names.size(); ++i)
        if (parameters.names[i] == name) return call.give(parameters.values[static_cast<Index>(i)]);
    throw InvalidArgument(fmt::format("this model has no parameter of that name; its parameters are {}",
                                      fmt::join(parameters.names, ", ")));
}

/// A matrix of a state-space model, or what the letter stands for in any other.
template <Matrix StateSpace::*kMatrix, int (*kOther)(Call&)>
int field_matrix(Call& call) {
    const Model& model = model_self(call);
    return model.system ? call.give_matrix((*model.system).*kMatrix) : kOther(call);
}

int field_C(Call& call) {
    if (const NoiseModel* noise = noise_of(call)) return call.give_vector(noise->C);
    return field_polynomial<&PolynomialModel::C>(call);
}
/// The letter D names the noise polynomial of a difference equation or of rivc, and the delay of step_delayed.
int field_D(Call& call) {
    if (const NoiseModel* noise = noise_of(call)) return call.give_vector(noise->D);
    return model_self(call).polynomial ? field_polynomial<&PolynomialModel::D>(call) : field_parameter(call);
}

int to_text_of_model(Call& call) {
    return call.give(channels_text(model_self(call)));
}

template <TransferFunction (*kOperator)(const TransferFunction&, const TransferFunction&)>
int combine(Call& call) {
    return give_model(call, kOperator(model_argument(call, 1, "left side").G, model_argument(call, 2, "right side").G));
}
TransferFunction plus(const TransferFunction& a, const TransferFunction& b) {
    return a + b;
}
TransferFunction minus(const TransferFunction& a, const TransferFunction& b) {
    return a - b;
}
TransferFunction times(const TransferFunction& a, const TransferFunction& b) {
    return a * b;
}
TransferFunction over(const TransferFunction& a, const TransferFunction& b) {
    return a / b;
}

int raise_to_power(Call& call) {
    return give_model(call, pow(model_argument(call, 1, "base").G, static_cast<int>(call.integer(2, "exponent"))));
}
int negate(Call& call) {
    const TransferFunction& G = only_channel(call);
    return give_model(call, TransferFunction(-G.num(), G.den(), G.Ts(), G.delay()));
}

constexpr std::array kModelTypeFields = {
    Member{"num", guarded<field_num>},
    Member{"den", guarded<field_den>},
    Member{"IODelay", guarded<field_delay>},
    Member{"Ts", guarded<field_sampling_time>},
    Member{"param", guarded<field_param>},
    Member{"std", guarded<field_std>},
    Member{"covariance", guarded<field_covariance>},
    Member{"noise_variance", guarded<field_noise_variance>},
    Member{"robust_std", guarded<field_robust_std>},
    Member{"robust_covariance", guarded<field_robust_covariance>},
    Member{"names", guarded<field_names>},
    Member{"report", guarded<field_report>},
    Member{"Kp", guarded<field_parameter>},
    Member{"Tp1", guarded<field_parameter>},
    Member{"Tp2", guarded<field_parameter>},
    Member{"Tp3", guarded<field_parameter>},
    Member{"Tw", guarded<field_parameter>},
    Member{"Zeta", guarded<field_parameter>},
    Member{"Tz", guarded<field_parameter>},
    Member{"Td", guarded<field_parameter>},
    Member{"K", guarded<field_parameter>},
    Member{"T", guarded<field_parameter>},
    Member{"z", guarded<field_parameter>},
    Member{"w0", guarded<field_parameter>},
    Member{"D", guarded<field_matrix<&StateSpace::D, field_D>>},
    Member{"A", guarded<field_matrix<&StateSpace::A, field_polynomial<&PolynomialModel::A>>>},
    Member{"B", guarded<field_matrix<&StateSpace::B, field_input_polynomials<&PolynomialModel::B>>>},
    Member{"C", guarded<field_matrix<&StateSpace::C, field_C>>},
    Member{"F", guarded<field_input_polynomials<&PolynomialModel::F>>},
    Member{"channels", guarded<field_channels>},
};
constexpr std::array kModelTypeOperators = {
    Member{"__add", guarded<combine<plus>>},         Member{"__sub", guarded<combine<minus>>},
    Member{"__mul", guarded<combine<times>>},        Member{"__div", guarded<combine<over>>},
    Member{"__pow", guarded<raise_to_power>},        Member{"__unm", guarded<negate>},
    Member{"__tostring", guarded<to_text_of_model>},
};

const StateSpace& system(Call& call) {
    return object_argument<StateSpace>(call, 1, "system");
}
int system_A(Call& call) {
    return call.give_matrix(system(call).A);
}
int system_B(Call& call) {
    return call.give_matrix(system(call).B);
}
int system_C(Call& call) {
    return call.give_matrix(system(call).C);
}
int system_D(Call& call) {
    return call.give_matrix(system(call).D);
}
int system_Ts(Call& call) {
    return call.give(system(call).Ts);
}
int system_text(Call& call) {
    const StateSpace& s = system(call);
    return call.give(fmt::format("A =\n{}\nB =\n{}\nC =\n{}\nD =\n{}{}", matrix_text(s.A), matrix_text(s.B),
                                 matrix_text(s.C), matrix_text(s.D),
                                 s.Ts > 0 ? fmt::format("\nTs = {} s", number_text(s.Ts)) : ""));
}

constexpr std::array kSystemFields = {Member{"A", guarded<system_A>}, Member{"B", guarded<system_B>},
                                      Member{"C", guarded<system_C>}, Member{"D", guarded<system_D>},
                                      Member{"Ts", guarded<system_Ts>}};
constexpr std::array kSystemOperators = {Member{"__tostring", guarded<system_text>}};

}  // namespace

const ObjectType Boxed<Model>::type{"model", kModelTypeFields, {}, kModelTypeOperators};
const ObjectType Boxed<StateSpace>::type{"state-space model", kSystemFields, {}, kSystemOperators};

}  // namespace dynlab::inline scripting
