
#include "figures/plots/cross_validation_plot.h"
#include "figures/plots/residual_plot.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/structure_advice.h"
#include "numerics/validation/crossvalidate.h"
#include "numerics/validation/residual_tests.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/simulated_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kResidualOptions[] = {
    option<&ResidualOptions::lags>("lags", about("number of lags to test")),
    option<&ResidualOptions::confidence>("confidence", about("confidence level of the bounds")),
    {"prediction",
     ValueKind::kFlag,
     about("true uses one-step prediction errors instead of simulation errors"),
     {.initial = "false"}},
    {"quiet", ValueKind::kFlag, about("true suppresses the text and the figure"), {.initial = "false"}}};
constexpr OptionEntry kFoldOptions[] = {
    option<&CrossValidationOptions::folds>("folds", about("number of parts (folds)")),
    option<&CrossValidationOptions::by_experiment>(
        "by_experiment", about("true leaves out one experiment at a time instead of one part")),
    {"InitialState",
     ValueKind::kChoice,
     kStateOption.description,
     {.initial = "\"estimate\"", .choices = kInitialStates, .former = "zero", .member = "initial_state"}},
    kOffsetOption};
constexpr OptionTable kResidualsTables[] = {kResidualOptions, kComparisonStart}, kFoldsTables[] = {kFoldOptions};

constexpr ArgumentEntry kFoldArguments[] = {
    {"data", ValueKind::kData, about("data object with one or several experiments")},
    {"fit", ValueKind::kAny, about("function of a data object that returns a model")}};

void push_independence(const Call& call, const IndependenceTest& test) {
    give_table(call, "correlation", test.correlation, "bound", test.bound, "outside", static_cast<double>(test.outside),
               "p_value", test.p_value, "p_value_future", test.p_value_future, "independent", test.independent,
               "without_feedback", test.without_feedback, "verdict", localized(call, test.verdict));
}

void push_output(const Call& call, const OutputResiduals& output) {
    lua_State* L = call.state();
    give_table(call, "mean", output.mean, "variance", output.variance, "exact", output.exact, "verdict",
               localized(call, output.verdict));
    if (output.exact) return;
    set_field(call, "correlation", output.whiteness.correlation, "bound", output.whiteness.bound, "outside",
              static_cast<double>(output.whiteness.outside), "p_value", output.whiteness.p_value, "white",
              output.whiteness.white);
    give_list(call, output.inputs, [&](const IndependenceTest& test) { push_independence(call, test); });
    lua_setfield(L, -2, "inputs");
}

/// Pushes a table with the fields outputs, residuals (per experiment), `verdict`, white and independent.
void push_tests(const Call& call, const ResidualTests& tests) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 5);
    bool white = true, independent = true;
    give_list(call, tests.outputs, [&](const OutputResiduals& output) {
        white = white && output.whiteness.white;
        for (const IndependenceTest& test : output.inputs) independent = independent && test.independent;
        push_output(call, output);
    });
    lua_setfield(L, -2, "outputs");
    give_list(call, tests.residuals, [&](const Matrix& residuals) { give_columns(call, residuals); });
    lua_setfield(L, -2, "residuals");
    set_field(call, "verdict", localized(call, tests.verdict), "white", white, "independent", independent);
}

/// Nothing for models that were not estimated.
ModelDoubts doubts_of(const Call& call, int index) {
    const Model* model = to_object<Model>(call.state(), index);
    if (model == nullptr || !model->estimate) return {};
    const Estimate& estimate = *model->estimate;
    const std::optional<StructureAdvice> missed = estimate.diagnostics.missed();
    return {undetermined_parameters(estimate.names, estimate.theta, estimate.std()),
            missed ? sentence_of(*missed) : Message(), missed ? missed->output : ""};
}

/// Of the model at argument 2.
ResidualTests tests_of_model(const Call& call, const IdData& data, const Options& options,
                             const ResidualOptions& requested) {
    const bool of_predictions = options.flag("prediction", false);
    if (!of_predictions && runs_freely(call, 2)) {
        const Comparison comparison = comparison_argument(call, 2, data, options);
        std::vector<Matrix> outputs;
        for (std::size_t k = 0; k < data.experiments.size(); ++k) outputs.push_back(comparison.outputs(k));
        return residual_tests(data, std::move(outputs), requested);
    }
    const CompareOptions start = compare_options(options);
    IdData storage;
    const IdData& driven = driving_data(call, 2, data, storage);
    if (of_predictions)
        return prediction_error_tests(driven, predict(driven, noisy_model_argument(call, 2, "G"), {1, start}),
                                      requested);
    return residual_tests(driven, channels_argument(call, 2, "G"), start, requested, doubts_of(call, 2));
}

int test_residuals(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 3, kResidualsTables);
    const bool quiet = options.flag("quiet", false);
    ResidualOptions requested;
    options.read(requested);
    const ResidualTests tests = tests_of_model(call, data, options, requested);
    if (!quiet) call.print(localized(call, tests.verdict) + "\n");
    bool drawable = false;
    for (const OutputResiduals& output : tests.outputs) drawable = drawable || !output.exact;
    if (drawable && !quiet)
        give_figure(call, residual_plot(tests, data, requested.confidence));
    else
        lua_pushnil(call.state());
    push_tests(call, tests);
    return 2;
}

/// Calls the script's function at argument 2 with a data object; its result is the model.
std::vector<TransferFunction> call_fitter(lua_State* L, const IdData& training) {
    lua_pushvalue(L, 2);
    push_object(L, training);
    lua_call(L, 1, 1);
    const Model* model = to_object<Model>(L, -1);
    if (model == nullptr)
        throw InvalidArgument(
            "the estimation function must return a model, as in function(d) return procsrivc(d, \"P1\") end, but it "
            "returned {}",
            given_value(L, -1));
    std::vector<TransferFunction> channels = channels_of(*model);
    lua_pop(L, 1);
    return channels;
}

void push_cross_validation(const Call& call, const CrossValidation& result) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 5);
    give_columns(call, result.fit_percent);
    lua_setfield(L, -2, "fit_percent");
    set_field(call, "mean", result.mean, "std", result.spread, "message", localized(call, result.message));
    give_list(call, result.folds, [&](const CrossValidationFold& fold) {
        give_table(call, "experiment", static_cast<double>(fold.experiment + 1), "first",
                   static_cast<double>(fold.first), "last", static_cast<double>(fold.last));
        give_model(call, fold.channels.front());
        lua_setfield(L, -2, "model");
    });
    lua_setfield(L, -2, "folds");
}

int validate_across(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    if (call.type(2) != LUA_TFUNCTION) wrong_argument(call.state(), 2, "fit", Message("a function of a data object"));
    const Options options(call, 3, kFoldsTables);
    CrossValidationOptions requested;
    options.read(requested);
    requested.simulation = compare_options(options, InitialState::kEstimate);
    requested.cancel = call.cancel();
    lua_State* L = call.state();
    const CrossValidation result = cross_validate(
        data, [L](const IdData& training) { return call_fitter(L, training); }, requested);
    call.print(localized(call, result.message) + "\n");
    give_figure(call, cross_validation_plot(result, data.output_names));
    push_cross_validation(call, result);
    return 2;
}

constexpr FunctionEntry kResidualsFunctions[] = {
    {"resid", "validation", "resid(data, G, {options}) -> fig, table",
     "Test the residuals for whiteness and independence of the input", guarded<test_residuals>, kResidualsTables,
     kDataAndModel},
    {"crossvalidate", "validation", "crossvalidate(data, fit, {options}) -> fig, table",
     "Cross-validate an estimation method", guarded<validate_across>, kFoldsTables, kFoldArguments},
};

}  // namespace

FunctionEntries residual_functions() {
    return kResidualsFunctions;
}

}  // namespace dynlab::inline scripting
