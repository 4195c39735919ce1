#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "figures/plots/compare_plot.h"
#include "numerics/fit/fit.h"
#include "numerics/validation/compare.h"
#include "numerics/validation/fit_measures.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/grey_object.h"
#include "scripting/objects/simulated_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kStepsOption = {
    "k", ValueKind::kNumber,
    about("prediction horizon in samples, as in `predict`; by default, the outputs are simulated")};
constexpr std::array kComparisonOptions = {kLabelsOption, kStepsOption};
constexpr std::array kFitOptions = {kStepsOption};
constexpr OptionTable kCompareTables[] = {kComparisonOptions, kComparisonStart},
                      kFitTables[] = {kFitOptions, kComparisonStart}, kMeasuresTables[] = {kComparisonStart};

constexpr ArgumentEntry kCompareArguments[] = {kDataSetArgument, {"G1, ...", ValueKind::kModel, about("models")}};
constexpr std::array kTestArguments = {kModelArgument, kDataSetArgument};

Message model_name(const Call& call, int index, const std::vector<std::string>& labels, std::size_t number) {
    if (number < labels.size()) return Message::verbatim(labels[number]);
    const std::string method = method_of_model(call, index);
    return method.empty() ? Message("model {}", number + 1) : Message::verbatim(method);
}

/// What one model says of all experiments.
struct ModelOutputs {
    Message name;
    std::vector<Matrix> y;
    std::vector<Vector> fit_percent;                          // per output
    std::vector<std::vector<std::optional<double>>> offsets;  // per output; none of predictions
};

template <class Result>
Vector fits_of(const std::vector<Result>& outputs) {
    Vector fits(static_cast<Index>(outputs.size()));
    for (std::size_t i = 0; i < outputs.size(); ++i) fits[static_cast<Index>(i)] = outputs[i].fit_percent;
    return fits;
}

template <class Results>
ModelOutputs model_outputs(Message name, const Results& all) {
    ModelOutputs outputs{std::move(name), {}, {}, {}};
    for (std::size_t k = 0; k < all.results.size(); ++k) {
        outputs.y.push_back(all.outputs(k));
        outputs.fit_percent.push_back(fits_of(all.results[k]));
        outputs.offsets.emplace_back();
    }
    return outputs;
}

bool holds_offset(const CompareResult& result) {
    return result.offset != 0;
}

ModelOutputs simulated_model_outputs(Message name, const Comparison& all) {
    ModelOutputs outputs = model_outputs(std::move(name), all);
    for (std::size_t k = 0; k < all.results.size(); ++k)
        for (const CompareResult& result : all.results[k])
            outputs.offsets[k].push_back(holds_offset(result) ? std::optional(result.offset) : std::nullopt);
    return outputs;
}

/// Whether nothing was noted of this line of the script yet, which may be called again and again.
bool is_first_of_line(lua_State* L) {
    static const char noted = 0;
    const ScriptPlace place = script_place(L);
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &noted) == LUA_TNIL) {
        lua_pop(L, 1);
        lua_newtable(L);
        lua_pushvalue(L, -1);
        lua_rawsetp(L, LUA_REGISTRYINDEX, &noted);
    }
    const std::string key = fmt::format("{}:{}", place.file, place.line);
    const bool first = lua_getfield(L, -1, key.c_str()) == LUA_TNIL;
    lua_pop(L, 1);
    lua_pushboolean(L, 1);
    lua_setfield(L, -2, key.c_str());
    lua_pop(L, 1);
    return first;
}

Message level_text(double level, const std::string& unit) {
    return unit.empty() ? Message("{}", significant(level, 3)) : Message("{} {}", significant(level, 3), unit);
}

/// Prints a line for each offset that the script did not request and that changes a printed digit of the fit.
void note_offsets(const Call& call, const IdData& data, const Comparison& comparison) {
    constexpr double kPrinted = 0.05;  // of a fit in per cent
    const Vector without = fits_without_offsets(data, comparison);
    MessageList lines{{}, Join::kLines};
    for (Index i = 0; i < without.size(); ++i) {
        if (!(comparison.fit_percent[i] - without[i] >= kPrinted)) continue;
        const auto output = static_cast<std::size_t>(i);
        MessageList offsets;
        for (const auto& results : comparison.results)
            offsets.items.push_back(level_text(results[output].offset, data.output_units[output]));
        lines.items.push_back(without.size() == 1
                                  ? Message("fit: an estimated offset of {} was removed; if the offset is not removed, "
                                            "the fit is {} %. To choose, set {} to \"estimate\" or \"none\".",
                                            offsets, significant(without[i], 4), OptionName{"offset"})
                                  : Message("fit: an estimated offset of {} was removed from {}; if the offset is not "
                                            "removed, the fit is {} %. To choose, set {} to \"estimate\" or \"none\".",
                                            offsets, data.output_names[output], significant(without[i], 4),
                                            OptionName{"offset"}));
    }
    if (lines.items.empty() || !is_first_of_line(call.state())) return;
    call.print(localized(call, Message("{}", lines)) + "\n");
}

/// The figures of all experiments under each other.
Figure comparison_figure(const IdData& data, const std::vector<ModelOutputs>& models) {
    Figure all;
    all.rows = 0;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        std::vector<ModelOutput> outputs;
        for (const ModelOutputs& model : models)
            outputs.push_back({model.name, model.y[k], model.fit_percent[k], model.offsets[k]});
        Figure one = compare_plot(data, outputs, k);
        if (data.experiments.size() > 1) one.panels.front().title = Message("experiment {}", k + 1);
        all.rows += one.rows;
        for (Panel& panel : one.panels) all.panels.push_back(std::move(panel));
    }
    return all;
}

/// Draws measured and simulated, with k predicted, output for the models from argument `first` on.
int draw_comparison(Call& call, const IdData& data, int first, int options_index) {
    if (!holds_model(call, first)) wrong_argument(call.state(), first, "G", with_article("model"));
    const Options options(call, options_index, kCompareTables);
    int count = 1;
    while (holds_model(call, first + count)) ++count;
    const std::vector<std::string> labels = labels_option(options, static_cast<std::size_t>(count));
    const std::optional<Index> steps = steps_option(options, std::nullopt);
    std::vector<ModelOutputs> models;
    for (int i = first; holds_model(call, i); ++i) {
        const Message name = with_steps(model_name(call, i, labels, models.size()), steps);
        models.push_back(
            steps ? model_outputs(name, prediction_argument(call, i, data, {steps, compare_options(options)}))
                  : simulated_model_outputs(name, comparison_argument(call, i, data, options)));
    }
    return give_figure(call, comparison_figure(data, models));
}

int compare_models(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    int next = 2;
    while (holds_model(call, next)) ++next;
    call.at_most(next);
    if (next > 2) read_steps_as_option(call, next);
    return draw_comparison(call, data, 2, next);
}

int test_model(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 2, "data");
    return draw_comparison(call, data, 1, 3);
}

int fit(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    read_steps_as_option(call, 3);
    const Options options(call, 3, kFitTables);
    const auto steps = steps_option(options, std::nullopt);
    const auto simulated = [&] {
        const Comparison comparison = comparison_argument(call, 2, data, options);
        if (!options.has("Offset")) note_offsets(call, data, comparison);
        return comparison.fit_percent;
    };
    const Vector percents =
        steps ? prediction_argument(call, 2, data, {steps, compare_options(options)}).fit_percent : simulated();
    for (const double percent : percents) lua_pushnumber(call.state(), percent);
    return static_cast<int>(percents.size());
}

/// What the measures ask of a model with one output.
struct MeasuredModel {
    Index parameters = 0;
    Vector theta;
    Matrix covariance;  ///< empty where the method gives none
};

void check_one_output(Index outputs) {
    if (outputs == 1) return;
    throw InvalidArgument(
        "fit_measures requires a model with one output, but the model has {}. Use fit, which accepts several outputs",
        outputs);
}

MeasuredModel measured_model(const Call& call, int index) {
    if (const SimulatedModel* simulated = simulated_model(call, index)) {
        check_one_output(simulated->run->output_count());
        return {simulated->estimate->theta.size(), simulated->estimate->theta, simulated->estimate->covariance()};
    }
    if (const GreyEstimate grey = to_grey_box(call, index)) {
        check_one_output(grey->fit.fit_percent.size());
        const std::vector<Index> free = grey->model.free_parameters();
        const auto count = static_cast<Index>(free.size());
        if (grey->fit.covariance.size() == 0 || !grey->fit.covariance.allFinite()) return {count, {}, {}};
        return {count, grey->fit.theta(free), grey->fit.covariance(free, free)};
    }
    const Model model = model_argument(call, index, "G");
    const Index count = parameters_of(model).values.size();
    if (!model.estimate) return {count, {}, {}};
    return {count, model.estimate->theta, model.estimate->covariance()};
}

int measure_fit(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 3, kMeasuresTables);
    const MeasuredModel model = measured_model(call, 2);
    const Comparison comparison = comparison_argument(call, 2, data, options);
    const LevelledOutputs pair = levelled_outputs(data, comparison);
    const Vector &y = pair.measured, &simulated = pair.simulated;
    const bool lost = !simulated.allFinite();  // the message says when
    const double mean_square = lost ? kInfinity : (y - simulated).squaredNorm() / static_cast<double>(y.size());
    const InformationCriteria criteria = information_criteria(mean_square, y.size(), model.parameters);
    give_table(call, "fit_percent", comparison.fit_percent[0], "r_squared_simulation",
               lost ? -kInfinity : r_squared_simulation(y, pair.swing), "rmse", std::sqrt(mean_square), "fpe",
               criteria.fpe, "aic", criteria.aic, "aicc", criteria.aicc, "bic", criteria.bic);
    if (model.covariance.size() > 0 && !lost)
        set_field(call, "yic", yic(y, pair.swing, model.theta, model.covariance).value);
    set_field(call, "output", comparison.results.front().front().output, "message",
              localized(call, comparison.results.front().front().message));
    return 1;
}

constexpr FunctionEntry kValidationFunctions[] = {
    {"test_your_model", "step tests", "test_your_model(G, data, {options}) -> fig",
     "Compare the measured response with the response of a model", guarded<test_model>, kCompareTables, kTestArguments},
    {"compare", "validation", "compare(data, G1, G2, ..., {options}) -> fig",
     "Compare measured with simulated or predicted outputs", guarded<compare_models>, kCompareTables,
     kCompareArguments},
    {"fit", "validation", "fit(data, G, {options}) -> percent", "Fit of the simulated or predicted output in percent",
     guarded<fit>, kFitTables, kDataAndModel},
    {"fit_measures", "validation", "fit_measures(data, G, {options}) -> table",
     "Compute fit, R_T^2, RMSE, FPE, AIC, BIC and YIC of the simulated output", guarded<measure_fit>, kMeasuresTables,
     kDataAndModel},
};

}  // namespace

FunctionEntries validation_functions() {
    return kValidationFunctions;
}

}  // namespace dynlab::inline scripting
