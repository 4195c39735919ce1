
#include "numerics/validation/prediction.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kPredictionOptions[] = {
    {"k", ValueKind::kNumber, about("number of samples ahead; `math.huge` for a simulation"), {.initial = "1"}}};
constexpr OptionTable kPredictionTables[] = {kPredictionOptions, kSimulationStart};

/// A number for one output, a vector for several.
void set_per_output(const Call& call, const char* name, const Vector& values) {
    values.size() == 1 ? set_field(call, name, values[0]) : set_field(call, name, values);
}

/// A vector, a matrix with a column for each of several outputs, and of several experiments a list of them.
void push_signals(const Call& call, const std::vector<Matrix>& signals) {
    const auto push = [&](const Matrix& one) {
        one.cols() == 1 ? call.give_vector(one.col(0)) : call.give_matrix(one);
    };
    if (signals.size() == 1) return push(signals.front());
    lua_createtable(call.state(), static_cast<int>(signals.size()), 0);
    for (std::size_t k = 0; k < signals.size(); ++k) {
        push(signals[k]);
        lua_rawseti(call.state(), -2, static_cast<lua_Integer>(k + 1));
    }
}

void push_report(const Call& call, const Predictions& all) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 4);
    set_per_output(call, "fit_percent", all.fit_percent);
    set_per_output(call, "loss", all.loss);
    set_field(call, "first", all.results.front().front().first + 1, "message", localized(call, all.message));
}

/// predict(data, G, {k =, ...}) or predict(data, G, k); with kErrors what they leave of the output.
template <bool kErrors>
int predict_output(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const NoisyModel model = noisy_model_argument(call, 2, "G");
    read_steps_as_option(call, 3);
    const Options options(call, 3, kPredictionTables);
    IdData storage;
    const Predictions all =
        predict(driving_data(call, 2, data, storage), model, {steps_option(options, 1), compare_options(options)});
    std::vector<Matrix> signals;
    for (std::size_t k = 0; k < data.experiments.size(); ++k)
        signals.push_back(kErrors ? all.output_errors(data, k) : all.outputs(k));
    push_signals(call, signals);
    push_report(call, all);
    return 2;
}

constexpr FunctionEntry kPredictionsFunctions[] = {
    {"predict", "validation", "predict(data, G, {options}) -> y, table", "Predict the output k steps ahead",
     guarded<predict_output<false>>, kPredictionTables, kDataAndModel},
    {"pe", "validation", "pe(data, G, {options}) -> e, table", "Compute prediction errors one or k steps ahead",
     guarded<predict_output<true>>, kPredictionTables, kDataAndModel},
};

}  // namespace

FunctionEntries prediction_functions() {
    return kPredictionsFunctions;
}

}  // namespace dynlab::inline scripting
