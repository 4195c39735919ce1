#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/present.h"
#include "scripting/objects/process_structure.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

const Model& model_self(Call& call) {
    return object_argument<Model>(call, 1, "G");
}

const Estimate& estimate_in(const Model& model) {
    if (!model.estimate)
        throw InvalidArgument("this model was specified, not estimated, so it has no standard errors and no report");
    return *model.estimate;
}

/// The transfer function of a model with one channel.
const TransferFunction& only_channel(const Model& model) {
    if (model.single_channel()) return model.G;
    throw InvalidArgument("this field exists only for models with one input and one output, but {}",
                          channels_hint(model));
}
Vector numerator_of(const Model& model) {
    return only_channel(model).num();
}
Vector denominator_of(const Model& model) {
    return only_channel(model).den();
}

const PolynomialModel& polynomials(Call& call) {
    const Model& model = model_self(call);
    if (model.polynomial) return *model.polynomial;
    throw InvalidArgument(
        "only discrete-time polynomial models, such as the results of arx, oe and sriv, have the field {}. lssvf and "
        "ivsvf return A and B. srivc, coe and tfsrivc return B and F. rivc returns B, C, D and F. n4sid returns the "
        "matrices A, B, C and D",
        call.function_name());
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
    if (kPolynomial == &PolynomialModel::A && is_carx(call)) return call.give_vector(denominator_of(model_self(call)));
    return call.give_vector(polynomials(call).*kPolynomial);
}
/// A vector, or a table of one vector for each of several inputs.
template <std::vector<Vector> PolynomialModel::*kPolynomials>
int field_input_polynomials(Call& call) {
    if (kPolynomials == &PolynomialModel::B && is_carx(call)) return call.give_vector(numerator_of(model_self(call)));
    if (has_form_of_output_error(model_self(call)))
        return call.give_vector(kPolynomials == &PolynomialModel::B ? numerator_of(model_self(call))
                                                                    : denominator_of(model_self(call)));
    const std::vector<Vector>& list = polynomials(call).*kPolynomials;
    return list.size() == 1 ? call.give_vector(list.front()) : give_value(call, list);
}

/// The transfer function from each input; with several outputs such a list for each.
int field_channels(Call& call) {
    const Model& model = model_self(call);
    const std::vector<TransferFunction> channels = channels_of(model);
    const auto give_channels = [&](std::span<const TransferFunction> row) {
        return give_list(call, row, [&](const TransferFunction& channel) { give_model(call, channel); });
    };
    if (model.outputs == 1) return give_channels(channels);
    std::vector<std::span<const TransferFunction>> rows;
    for (std::size_t output = 0; output < model.outputs; ++output)
        rows.push_back(std::span(channels).subspan(output * model.inputs(), model.inputs()));
    return give_list(call, rows, give_channels);
}

/// G.history: a plain table.
int field_history(Call& call) {
    const Estimate& estimate = estimate_in(model_self(call));
    if (!estimate.history)
        throw InvalidArgument("{} processes all samples at once; rlssvf, rivsvf and rsrivc return a history",
                              estimate.method);
    return give_table(call, "t", estimate.history->t, "theta", estimate.history->theta, "std", estimate.history->std,
                      "names", estimate.names);
}

double noise_variance_of(const Model& model) {
    const Estimate& estimate = estimate_in(model);
    if (const std::optional<double> variance = estimate.report().number("noise_variance")) return *variance;
    throw InvalidArgument("{} does not estimate the variance of the noise", estimate.method);
}

std::shared_ptr<const Assessment> assessment_of(const Model& model) {
    const Estimate& estimate = estimate_in(model);
    if (auto assessment = estimate.diagnostics.assessment()) return assessment;
    throw InvalidArgument("{} does not compute robust standard errors", estimate.method);
}

int field_report(Call& call) {
    push_report(call, estimate_in(model_self(call)));
    return 1;
}

/// G.Kp, G.Tp1, G.K, ...: a parameter by its name, which is the field's own.
int field_parameter(Call& call) {
    const std::string name = call.function_name();
    const ModelParameters parameters = parameters_of(model_self(call));
    for (std::size_t i = 0; i < parameters.names.size(); ++i)
        if (parameters.names[i] == name) return call.give(parameters.values[static_cast<Index>(i)]);
    throw InvalidArgument("this model has no parameter {}; its parameters are {}", name, listed(parameters.names));
}

/// A matrix of a state-space model, or the field of the same letter of other models.
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

template <TransferFunction (*kOperator)(const TransferFunction&, const TransferFunction&)>
int combine(Call& call) {
    return give_model(call, kOperator(model_argument(call, 1, Message("left side")).G,
                                      model_argument(call, 2, Message("right side")).G));
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
    const TransferFunction& G = only_channel(model_self(call));
    return give_model(call, TransferFunction(-G.num(), G.den(), G.Ts(), G.delay()));
}

constexpr std::array kModelTypeFields = {
    Member{"num", field<Model, numerator_of>},
    Member{"den", field<Model, denominator_of>},
    Member{"IODelay", field<Model, [](const Model& model) { return only_channel(model).delay(); }>},
    Member{"Ts", field<Model, [](const Model& model) { return model.G.Ts(); }>},
    Member{"param", field<Model, [](const Model& model) { return parameters_of(model).values; }>},
    Member{"std", field<Model, [](const Model& model) { return estimate_in(model).std(); }>},
    Member{"covariance", field<Model, [](const Model& model) { return estimate_in(model).covariance(); }>},
    Member{"noise_variance", field<Model, noise_variance_of>},
    Member{"robust_std", field<Model, [](const Model& model) { return assessment_of(model)->std; }>},
    Member{"robust_covariance", field<Model, [](const Model& model) { return assessment_of(model)->covariance; }>},
    Member{"names", field<Model, [](const Model& model) { return parameters_of(model).names; }>},
    Member{"report", guarded<field_report>},
    Member{"history", guarded<field_history>},
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
    Member{"__add", guarded<combine<plus>>},
    Member{"__sub", guarded<combine<minus>>},
    Member{"__mul", guarded<combine<times>>},
    Member{"__div", guarded<combine<over>>},
    Member{"__pow", guarded<raise_to_power>},
    Member{"__unm", guarded<negate>},
    Member{"__tostring", localized_field<Model, channels_text>},
};

std::string system_text(const StateSpace& s, const Reader& reader) {
    const auto text = [&](const Matrix& matrix) { return matrix_text(matrix, reader); };
    return fmt::format("A =\n{}\nB =\n{}\nC =\n{}\nD =\n{}{}", text(s.A), text(s.B), text(s.C), text(s.D),
                       s.Ts > 0 ? fmt::format("\nTs = {} s", number_text(s.Ts)) : "");
}

constexpr std::array kSystemFields = {
    Member{"A", field<StateSpace, &StateSpace::A>}, Member{"B", field<StateSpace, &StateSpace::B>},
    Member{"C", field<StateSpace, &StateSpace::C>}, Member{"D", field<StateSpace, &StateSpace::D>},
    Member{"Ts", field<StateSpace, &StateSpace::Ts>}};
constexpr std::array kSystemOperators = {Member{"__tostring", localized_field<StateSpace, system_text>}};

Message free_structure_text(const ProcessStructure& structure) {
    return Message("{} with the free parameters {}: estimate them with procsrivc(data, ...)", structure.text(),
                   listed(structure.parameter_names()));
}

/// A parameter that has no value yet.
int field_free_parameter(Call& call) {
    const auto names = object_argument<ProcessStructure>(call, 1, "structure").parameter_names();
    if (std::find(names.begin(), names.end(), call.function_name()) != names.end())
        return call.give(std::numeric_limits<double>::quiet_NaN());
    throw InvalidArgument("this structure has no parameter {}; its parameters are {}", call.function_name(),
                          listed(names));
}

constexpr lua_CFunction kFreeParameter = guarded<field_free_parameter>;
constexpr std::array kStructureFields = {Member{"structure", field<ProcessStructure, &ProcessStructure::text>},
                                         Member{"names", field<ProcessStructure, &ProcessStructure::parameter_names>},
                                         Member{"Kp", kFreeParameter},
                                         Member{"Tp1", kFreeParameter},
                                         Member{"Tp2", kFreeParameter},
                                         Member{"Tp3", kFreeParameter},
                                         Member{"Tw", kFreeParameter},
                                         Member{"Zeta", kFreeParameter},
                                         Member{"Tz", kFreeParameter},
                                         Member{"Td", kFreeParameter}};
constexpr std::array kStructureOperators = {
    Member{"__tostring", localized_field<ProcessStructure, free_structure_text>}};

constexpr std::array kModelTypes = {
    TypeEntry{&Userdata<Model>::type, kModelTypeFields, {}, kModelTypeOperators},
    TypeEntry{&Userdata<ProcessStructure>::type, kStructureFields, {}, kStructureOperators},
    TypeEntry{&Userdata<StateSpace>::type, kSystemFields, {}, kSystemOperators}};

}  // namespace

TypeEntries model_types() {
    return kModelTypes;
}

}  // namespace dynlab::inline scripting
