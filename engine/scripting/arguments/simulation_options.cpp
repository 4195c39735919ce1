#include "scripting/arguments/simulation_options.h"

#include <cmath>

#include "numerics/signals/interpolation.h"
#include "numerics/validation/grey_box/grey_comparison.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/grey_object.h"
#include "scripting/objects/simulated_model.h"

namespace dynlab::inline scripting {

CompareOptions compare_options(const Options& options, InitialState otherwise) {
    CompareOptions requested{otherwise, Offset::kAuto};
    options.read(requested);
    if (options.has("InitialState")) requested.initial_state = static_cast<InitialState>(options.choice(kStateOption));
    return requested;
}

Hold hold_option(const Options& options, Hold fallback) {
    return options.has("hold") ? static_cast<Hold>(options.choice(kHoldOption)) : fallback;
}

std::vector<std::string> labels_option(const Options& options, std::size_t count) {
    std::vector<std::string> labels = options.texts("labels");
    if (!labels.empty() && labels.size() != count)
        throw InvalidArgument("option 'labels' has {} for {}; specify one string per model",
                              plural(labels.size(), "{} string", "{} strings"), plural(count, "{} model", "{} models"));
    return labels;
}

double confidence_option(const Options& options) {
    const double level = options.number("confidence", 0.99);
    if (level > 0 && level < 1) return level;
    refuse_option("confidence", Message("a confidence level between 0 and 1, such as 0.99"),
                  Message("{}", significant(level, 10)));
}

std::vector<TransferFunction> channels_argument(const Call& call, int index, ArgumentName what) {
    if (index <= call.count())
        if (const Model* model = to_object<Model>(call.state(), index)) return channels_of(*model);
    return {model_argument(call, index, what).G};
}

Comparison comparison_argument(const Call& call, int index, const IdData& data, const Options& options) {
    if (const GreyEstimate grey = to_grey_box(call, index)) {
        const std::string start = options.text("InitialState", "auto");
        return compare_grey(data, *grey,
                            start == "auto" ? usual_start(*grey) : parse_grey_start(start == "none" ? "zero" : start));
    }
    const SimulatedModel* simulated = simulated_model(call, index);
    if (simulated == nullptr) {
        IdData storage;
        return compare_all(driving_data(call, index, data, storage), channels_argument(call, index, "G"),
                           compare_options(options));
    }
    Comparison comparison = compare_all(data, *simulated->run);
    for (const auto& outputs : comparison.results)
        if (!outputs.front().output.allFinite()) call.print(localized(call, outputs.front().message) + "\n");
    return comparison;
}

NoisyModel noisy_model_argument(const Call& call, int index, ArgumentName what) {
    NoisyModel noisy;
    noisy.channels = channels_argument(call, index, what);
    const Model* model = to_object<Model>(call.state(), index);
    if (model == nullptr) return noisy;
    noisy.polynomial = model->polynomial;
    if (!model->estimate || !model->estimate->noise) return noisy;
    noisy.C = model->estimate->noise->C;
    noisy.D = model->estimate->noise->D;
    noisy.noise_Ts = model->estimate->noise->Ts;
    return noisy;
}

Predictions prediction_argument(const Call& call, int index, const IdData& data, const PredictionOptions& options) {
    IdData storage;
    return predict(driving_data(call, index, data, storage), noisy_model_argument(call, index, "G"), options);
}

namespace {

const Vector* vector_of(const Estimate& estimate, const char* name) {
    for (const auto& [own, values] : estimate.report().vectors)
        if (own == name) return &values;
    return nullptr;
}

/// The estimate of a model that begins with a static characteristic.
const Estimate* characteristic_of(const Call& call, int index) {
    const Model* model = index <= call.count() ? to_object<Model>(call.state(), index) : nullptr;
    if (model == nullptr || !model->estimate || vector_of(*model->estimate, "breakpoints") == nullptr) return nullptr;
    return model->estimate.get();
}

/// Models and data whose channels agree only in their number, such as two inputs of the model and two outputs of the
/// data.
void refuse_transposed_channels(const Call& call, int index, const IdData& data) {
    const Model* model = index <= call.count() ? to_object<Model>(call.state(), index) : nullptr;
    if (model == nullptr) return;
    const auto inputs = static_cast<Index>(model->inputs()), outputs = static_cast<Index>(model->outputs);
    if (inputs * outputs != data.input_count() * data.output_count() || inputs == data.input_count()) return;
    throw InvalidArgument("the model has {} and {}, but the data have {} and {}; select the channels with data:select",
                          plural(inputs, "{} input", "{} inputs"), plural(outputs, "{} output", "{} outputs"),
                          plural(data.input_count(), "{} input", "{} inputs"),
                          plural(data.output_count(), "{} output", "{} outputs"));
}

}  // namespace

Matrix driving_input(const Call& call, int index, const Matrix& u) {
    const Estimate* estimate = characteristic_of(call, index);
    if (estimate == nullptr || u.cols() != 1) return u;
    return interpolate_linearly(*vector_of(*estimate, "breakpoints"), *vector_of(*estimate, "levels"), u.col(0),
                                Outside::kHold);
}

const IdData& driving_data(const Call& call, int index, const IdData& data, IdData& storage) {
    refuse_transposed_channels(call, index, data);
    if (characteristic_of(call, index) == nullptr) return data;
    storage = data;
    for (Experiment& experiment : storage.experiments) experiment.u = driving_input(call, index, experiment.u);
    return storage;
}

void read_steps_as_option(const Call& call, int index) {
    if (call.type(index) != LUA_TNUMBER) return;
    lua_State* L = call.state();
    give_table(call, "k", call.number(index, "k"));
    lua_replace(L, index);
}

std::optional<Index> steps_option(const Options& options, std::optional<Index> fallback) {
    const auto steps = options.optional_number("k");
    if (!steps) return fallback;
    if (std::isinf(*steps) && *steps > 0) return std::nullopt;
    if (*steps >= 1 && *steps <= 1e9 && *steps == std::floor(*steps)) return static_cast<Index>(*steps);
    refuse_option("k", Message("a whole number of steps, at least 1, or math.huge for a simulation"),
                  Message("{}", significant(*steps, 10)));
}

Message with_steps(const Message& name, const std::optional<Index>& steps) {
    if (!steps) return name;
    return Message("{}, {}", name, plural(*steps, "{} step ahead", "{} steps ahead"));
}

}  // namespace dynlab::inline scripting
