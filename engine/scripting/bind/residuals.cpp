#include <array>

#include "figures/plots/cross_validation_plot.h"
#include "figures/plots/residual_plot.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/missed_options.h"
#include "numerics/validation/crossvalidate.h"
#include "numerics/validation/residual_tests.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/arguments/table_fields.h"
#include "scripting/bind/bindings.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

void push_independence(const Call& call, const IndependenceTest& test) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 8);
    set_vector(call, "correlation", test.correlation);
    set_number(L, "bound", test.bound);
    set_number(L, "outside", static_cast<double>(test.outside));
    set_number(L, "p_value", test.p_value);
    set_number(L, "p_value_future", test.p_value_future);
    set_flag(L, "independent", test.independent);
    set_flag(L, "without_feedback", test.without_feedback);
    set_text(call, "verdict", test.verdict);
}

void push_output(const Call& call, const OutputResiduals& output) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 10);
    set_number(L, "mean", output.mean);
    set_number(L, "variance", output.variance);
    set_flag(L, "exact", output.exact);
    set_text(call, "verdict", output.verdict);
    if (output.exact) return;
    set_vector(call, "correlation", output.whiteness.correlation);
    set_number(L, "bound", output.whiteness.bound);
    set_number(L, "outside", static_cast<double>(output.whiteness.outside));
    set_number(L, "p_value", output.whiteness.p_value);
    set_flag(L, "white", output.whiteness.white);
    lua_createtable(L, static_cast<int>(output.inputs.size()), 0);
    for (std::size_t j = 0; j < output.inputs.size(); ++j) {
        push_independence(call, output.inputs[j]);
        lua_rawseti(L, -2, static_cast<lua_Integer>(j + 1));
    }
    lua_setfield(L, -2, "inputs");
}

/// {outputs = {...}, residuals = {per experiment}, verdict =, white =, independent =}
void push_tests(const Call& call, const ResidualTests& tests) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 5);
    bool white = true, independent = true;
    lua_createtable(L, static_cast<int>(tests.outputs.size()), 0);
    for (std::size_t i = 0; i < tests.outputs.size(); ++i) {
        white = white && tests.outputs[i].whiteness.white;
        for (const IndependenceTest& test : tests.outputs[i].inputs) independent = independent && test.independent;
        push_output(call, tests.outputs[i]);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
    lua_setfield(L, -2, "outputs");
    lua_createtable(L, static_cast<int>(tests.residuals.size()), 0);
    for (std::size_t k = 0; k < tests.residuals.size(); ++k) {
        const Matrix& residuals = tests.residuals[k];
        residuals.cols() == 1 ? call.give_vector(residuals.col(0)) : call.give_matrix(residuals);
        lua_rawseti(L, -2, static_cast<lua_Integer>(k + 1));
    }
    lua_setfield(L, -2, "residuals");
    set_text(call, "verdict", tests.verdict);
    set_flag(L, "white", white);
    set_flag(L, "independent", independent);
}

/// Nothing for models that were not estimated.
ModelDoubts doubts_of(const Call& call, int index) {
    const Model* model = to_object<Model>(call.state(), index);
    if (model == nullptr || !model->estimate) return {};
    const Estimate& estimate = *model->estimate;
    return {undetermined_names(estimate.names, estimate.theta, estimate.std), missed_option_among(estimate.warnings)};
}

int test_residuals(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 3, {"lags", "confidence", "InitialState", "Offset", "quiet"});
    const bool quiet = options.flag("quiet", false);
    ResidualOptions wanted;
    wanted.lags = options.size("lags", wanted.lags);
    wanted.confidence = options.number("confidence", wanted.confidence);
    const ResidualTests tests =
        residual_tests(data, channels_argument(call, 2, "G"), compare_options(options), wanted, doubts_of(call, 2));
    if (!quiet) call.print(tests.verdict + "\n");
    bool drawable = false;
    for (const OutputResiduals& output : tests.outputs) drawable = drawable || !output.exact;
    if (drawable && !quiet)
        give_figure(call, residual_plot(tests, data, wanted.confidence));
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
        throw InvalidArgument(fmt::format(
            "the function that fits must return a model, as in function(d) return procsrivc(d, \"P1\") end, but it "
            "returned {}",
            given_text(L, -1)));
    std::vector<TransferFunction> channels = channels_of(*model);
    lua_pop(L, 1);
    return channels;
}

void push_cross_validation(const Call& call, const CrossValidation& result) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 5);
    result.fit_percent.cols() == 1 ? call.give_vector(result.fit_percent.col(0)) : call.give_matrix(result.fit_percent);
    lua_setfield(L, -2, "fit_percent");
    set_vector(call, "mean", result.mean);
    set_vector(call, "std", result.spread);
    set_text(call, "message", result.message);
    lua_createtable(L, static_cast<int>(result.folds.size()), 0);
    for (std::size_t k = 0; k < result.folds.size(); ++k) {
        const CrossValidationFold& fold = result.folds[k];
        lua_createtable(L, 0, 4);
        set_number(L, "experiment", static_cast<double>(fold.experiment + 1));
        set_number(L, "first", static_cast<double>(fold.first));
        set_number(L, "last", static_cast<double>(fold.last));
        give_model(call, fold.channels.front());
        lua_setfield(L, -2, "model");
        lua_rawseti(L, -2, static_cast<lua_Integer>(k + 1));
    }
    lua_setfield(L, -2, "folds");
}

int validate_across(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    if (call.type(2) != LUA_TFUNCTION) wrong_argument(call.state(), 2, "fit", "function of a data object");
    const Options options(call, 3, {"folds", "by_experiment", "InitialState", "Offset"});
    CrossValidationOptions wanted;
    wanted.folds = static_cast<int>(options.size("folds", wanted.folds));
    wanted.by_experiment = options.flag("by_experiment", false);
    wanted.simulation = compare_options(options, "estimate");
    wanted.cancel = call.cancel();
    lua_State* L = call.state();
    const CrossValidation result = cross_validate(
        data, [L](const IdData& training) { return call_fitter(L, training); }, wanted);
    call.print(result.message + "\n");
    give_figure(call, cross_validation_plot(result, data.output_names));
    push_cross_validation(call, result);
    return 2;
}

constexpr const char* kResidualsArea = "validation";
constexpr std::array kResidualsFunctions = {
    FunctionEntry{"resid", kResidualsArea,
                  "resid(data, G, {lags =, confidence =, InitialState =, Offset =, quiet =}) -> fig, table",
                  "is the simulation error white and independent of the input? with a verdict in words",
                  guarded<test_residuals>},
    FunctionEntry{"crossvalidate", kResidualsArea,
                  "crossvalidate(data, fit, {folds =, by_experiment =, InitialState =, Offset =}) -> fig, table",
                  "fits on all parts but one and simulates on that one, part by part", guarded<validate_across>},
};

}  // namespace

FunctionEntries residual_functions() {
    return kResidualsFunctions;
}

}  // namespace dynlab::inline scripting
