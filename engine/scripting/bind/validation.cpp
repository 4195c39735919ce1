#include <array>
#include <cmath>

#include "figures/plots/compare_plot.h"
#include "numerics/validation/compare.h"
#include "numerics/validation/fit_measures.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/arguments/table_fields.h"
#include "scripting/bind/bindings.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

std::string model_name(const Call& call, int index, const std::vector<std::string>& labels, std::size_t number) {
    if (number < labels.size()) return labels[number];
    const Model* model = to_object<Model>(call.state(), index);
    return model != nullptr && model->estimate ? model->estimate->method : fmt::format("model {}", number + 1);
}

ModelOutput model_output(std::string name, const Comparison& comparison, std::size_t experiment) {
    ModelOutput output{std::move(name), comparison.outputs(experiment), {}};
    output.fit_percent.resize(output.y.cols());
    for (Index i = 0; i < output.y.cols(); ++i)
        output.fit_percent[i] = comparison.results[experiment][static_cast<std::size_t>(i)].fit_percent;
    return output;
}

/// The figures of all experiments under each other.
Figure comparison_figure(const IdData& data, const std::vector<std::string>& names,
                         const std::vector<Comparison>& comparisons) {
    Figure all;
    all.rows = 0;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        std::vector<ModelOutput> outputs;
        for (std::size_t i = 0; i < names.size(); ++i) outputs.push_back(model_output(names[i], comparisons[i], k));
        Figure one = compare_plot(data, outputs, k);
        if (data.experiments.size() > 1) one.panels.front().title = fmt::format("experiment {}", k + 1);
        all.rows += one.rows;
        for (Panel& panel : one.panels) all.panels.push_back(std::move(panel));
    }
    return all;
}

/// Draws measured and simulated output for the models from argument `first` on.
int draw_comparison(Call& call, const IdData& data, int first, int options_index) {
    const Options options(call, options_index, {"labels", "InitialState", "Offset"});
    const std::vector<std::string> labels = options.texts("labels");
    std::vector<std::string> names;
    std::vector<Comparison> comparisons;
    for (int i = first; holds_model(call, i); ++i) {
        names.push_back(model_name(call, i, labels, names.size()));
        comparisons.push_back(compare_all(data, channels_argument(call, i, "G"), compare_options(options)));
    }
    if (names.empty()) wrong_argument(call.state(), first, "G", "model");
    return give_figure(call, comparison_figure(data, names, comparisons));
}

int compare_models(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    int next = 2;
    while (holds_model(call, next)) ++next;
    call.at_most(next);
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
    const Comparison comparison = compare_all(data, channels_argument(call, 2, "G"),
                                              compare_options(Options(call, 3, {"InitialState", "Offset"})));
    return call.give(comparison.fit_percent[0]);
}

int measure_fit(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Model model = model_argument(call, 2, "G");
    const Comparison comparison =
        compare_all(data, {model.G}, compare_options(Options(call, 3, {"InitialState", "Offset"})));
    const LevelledOutputs pair = levelled_outputs(data, comparison);
    const Vector &y = pair.measured, &simulated = pair.simulated;
    const double mean_square = (y - simulated).squaredNorm() / static_cast<double>(y.size());
    const InformationCriteria criteria =
        information_criteria(mean_square, y.size(), parameters_of(model).values.size());
    lua_createtable(call.state(), 0, 10);
    set_field(call, "fit_percent", fit_percent(y, simulated));
    set_field(call, "r_squared_simulation", r_squared_simulation(y, simulated));
    set_field(call, "rmse", std::sqrt(mean_square));
    set_field(call, "fpe", criteria.fpe);
    set_field(call, "aic", criteria.aic);
    set_field(call, "aicc", criteria.aicc);
    set_field(call, "bic", criteria.bic);
    if (model.estimate && model.estimate->covariance.size() > 0)
        set_field(call, "yic", yic(y, simulated, model.estimate->theta, model.estimate->covariance).value);
    set_field(call, "output", comparison.results.front().front().output);
    set_field(call, "message", comparison.results.front().front().message);
    return 1;
}

constexpr const char* kValidationArea = "validation";
constexpr std::array kValidationFunctions = {
    FunctionEntry{"test_your_model", "step tests", "test_your_model(G, data, {InitialState =, Offset =}) -> fig",
                  "measured response and the model's over each other", guarded<test_model>},
    FunctionEntry{"compare", kValidationArea, "compare(data, G1, G2, ..., {labels =, InitialState =, Offset =}) -> fig",
                  "measured and simulated outputs with their fits", guarded<compare_models>},
    FunctionEntry{"fit", kValidationArea, "fit(data, G, {InitialState =, Offset =}) -> percent",
                  "fit of the simulated output, 100 % is perfect", guarded<fit>},
    FunctionEntry{"fit_measures", kValidationArea, "fit_measures(data, G, {InitialState =, Offset =}) -> table",
                  "fit, R_T^2, RMSE, FPE, AIC, BIC and YIC of the simulated output", guarded<measure_fit>},
};

}  // namespace

FunctionEntries validation_functions() {
    return kValidationFunctions;
}

}  // namespace dynlab::inline scripting
