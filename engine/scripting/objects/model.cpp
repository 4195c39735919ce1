#include "scripting/objects/model.h"

#include "numerics/simulation/grey_simulation.h"
#include "scripting/objects/grey_object.h"
#include "scripting/objects/simulated_model.h"

namespace dynlab::inline scripting {

std::size_t Userdata<Model>::outside_bytes(const Model& model) {
    std::size_t numbers = static_cast<std::size_t>(model.G.num().size() + model.G.den().size());
    if (model.estimate)
        if (const ReportFields* fields = model.estimate->fields.known()) numbers += fields->values();
    if (model.estimate && model.estimate->history)
        numbers += static_cast<std::size_t>(2 * model.estimate->history->theta.size());
    return numbers * sizeof(double);
}

std::size_t Userdata<StateSpace>::outside_bytes(const StateSpace& system) {
    return sizeof(double) *
           static_cast<std::size_t>(system.A.size() + system.B.size() + system.C.size() + system.D.size());
}

std::optional<double> ReportFields::number(std::string_view name) const {
    for (const auto& [own, value] : numbers)
        if (own == name) return value;
    return std::nullopt;
}

std::size_t ReportFields::values() const {
    std::size_t sum = 0;
    for (const auto& [name, values] : vectors) sum += static_cast<std::size_t>(values.size());
    for (const auto& [name, values] : matrices) sum += static_cast<std::size_t>(values.size());
    return sum;
}

Message Estimate::full_message() const {
    const std::optional<StructureAdvice>& missed = diagnostics.missed();
    if (!missed) return message;
    return message.empty() ? sentence_of(*missed) : sentences({message, sentence_of(*missed)});
}

std::vector<Message> Estimate::all_warnings() const {
    std::vector<Message> all = warnings;
    if (const std::optional<StructureAdvice>& missed = diagnostics.missed()) all.push_back(sentence_of(*missed));
    return all;
}

std::shared_ptr<const Assessment> Estimate::color() const {
    std::shared_ptr<const Assessment> assessment = diagnostics.assessment();
    return assessment && !assessment->white ? assessment : nullptr;
}

Matrix Estimate::trusted_covariance() const {
    const auto colored = color();
    return colored ? colored->covariance : covariance();
}

bool holds_model(const Call& call, int index) {
    return index <= lua_gettop(call.state()) &&
           (runs_freely(call, index) || to_object<Model>(call.state(), index) != nullptr ||
            to_object<StateSpace>(call.state(), index) != nullptr);
}

Message channels_hint(const Model& model) {
    return Message("the model has {} and {}; use one of its channels, {}",
                   plural(model.inputs(), "{} input", "{} inputs"), plural(model.outputs, "{} output", "{} outputs"),
                   model.outputs == 1 ? Message("G.channels[1] for the first input")
                                      : Message("G.channels[2][1] for the second output and first input"));
}

namespace {

[[noreturn]] void refuse_simulated(int index, ArgumentName what, const Message& kind) {
    throw InvalidArgument("{} must be a linear model, but {} is not linear; use lsim, compare, fit or resid",
                          argument_label(index, what), kind);
}

/// A grey-box model with linear equations, one input and one output.
Model linear_grey_model(const GreyFit& grey, int index, ArgumentName what) {
    const auto system = linear_system_of(grey.model, grey.fit.theta);
    if (!system) refuse_simulated(index, what, Message("this grey-box model"));
    if (system->B.cols() == 1 && system->C.rows() == 1) return {to_transfer_function(*system)};
    throw InvalidArgument("{} must have one input and one output, but it has {} and {}", argument_label(index, what),
                          plural(system->B.cols(), "{} input", "{} inputs"),
                          plural(system->C.rows(), "{} output", "{} outputs"));
}

}  // namespace

Model model_argument(const Call& call, int index, ArgumentName what) {
    if (index <= call.count()) {
        if (const Model* model = to_object<Model>(call.state(), index)) {
            if (model->single_channel()) return *model;
            throw InvalidArgument("{} must have one input and one output, but {}", argument_label(index, what),
                                  channels_hint(*model));
        }
        if (const GreyEstimate grey = to_grey_box(call, index)) return linear_grey_model(*grey, index, what);
        if (const SimulatedModel* simulated = simulated_model(call, index))
            refuse_simulated(index, what, Message("this model from {}", simulated->estimate->method));
        if (call.type(index) == LUA_TNUMBER)
            return {TransferFunction(Vector::Constant(1, call.number(index, what)), Vector::Ones(1))};
        if (const StateSpace* system = to_object<StateSpace>(call.state(), index)) {
            if (system->B.cols() == 1 && system->C.rows() == 1) return {to_transfer_function(*system)};
            throw InvalidArgument("{} must have one input and one output, but it has {} and {}",
                                  argument_label(index, what), plural(system->B.cols(), "{} input", "{} inputs"),
                                  plural(system->C.rows(), "{} output", "{} outputs"));
        }
    }
    wrong_argument(call.state(), index, what, with_article("model"));
}

int give_model(const Call& call, TransferFunction G) {
    push_object(call.state(), Model{std::move(G)});
    return 1;
}

std::vector<TransferFunction> channels_of(const Model& model) {
    if (!model.channels.empty()) return model.channels;
    if (!model.polynomial) return {model.G};
    std::vector<TransferFunction> channels;
    for (std::size_t i = 0; i < model.inputs(); ++i) channels.push_back(model.polynomial->transfer_function(i));
    return channels;
}

std::optional<UncertainModel> uncertain_model(const Model& model) {
    if (!model.estimate || !model.G.continuous() || !model.single_channel()) return std::nullopt;
    const Matrix covariance = model.estimate->trusted_covariance();
    if (covariance.size() == 0 || !covariance.allFinite()) return std::nullopt;
    if (model.process) return UncertainModel(*model.process, covariance);
    if (!model.estimate->of_coefficients) return std::nullopt;
    const Index coefficients = model.G.pole_count() + model.G.num().size();
    if (covariance.rows() != coefficients && covariance.rows() != coefficients + 1) return std::nullopt;
    return UncertainModel(model.G, covariance);
}

ModelParameters parameters_of(const Model& model) {
    if (model.estimate && !model.system) return {model.estimate->names, model.estimate->theta, model.estimate->std()};
    if (model.process) return {model.process->structure.parameter_names(), model.process->parameters, {}};
    ModelParameters result;
    const Vector &num = model.G.num(), &den = model.G.den();
    result.values.resize(den.size() - 1 + num.size());
    result.values << den.tail(den.size() - 1), num;
    for (Index i = 1; i < den.size(); ++i) result.names.push_back(fmt::format("a{}", i));
    for (Index i = 0; i < num.size(); ++i) result.names.push_back(fmt::format("b{}", i));
    return result;
}

}  // namespace dynlab::inline scripting
