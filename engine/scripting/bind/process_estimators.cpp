#include <array>

#include "base/catalog.h"
#include "figures/step_construction.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/estimators/step_test.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/process_structure.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kConstructionOptions = {OptionEntry{"xlabel", ValueKind::kText, about("x-axis label")},
                                             OptionEntry{"ylabel", ValueKind::kText, about("y-axis label")}};
constexpr OptionTable kConstruction[] = {kConstructionOptions};
constexpr OptionTable kProcsrivc[] = {kDelayOptions, kStartOptions, kLimitOptions};

constexpr std::array kStepArguments = {
    ArgumentEntry{"data", ValueKind::kData,
                  about("data object with one output and one input with a single step, up or down from any level")}};
constexpr std::array kConstructionArguments = {
    ArgumentEntry{"G", ValueKind::kModel, about("result of step_first_order, step_second_order or step_delayed")}};
constexpr std::array kProcsrivcArguments = {
    ArgumentEntry{"data", ValueKind::kData,
                  about("data object with one input and one output, one or several experiments, regularly or "
                        "irregularly sampled; the intersample behavior is \"zoh\" or \"foh\"")},
    ArgumentEntry{"structure", ValueKind::kProcess,
                  about("letter P and number of poles (1 to 3), followed by any of D (delay), I (integrator), Z (zero) "
                        "and U (underdamped), such as \"P2DU\"; or a result of `idproc` without parameter values")}};

template <StepTestResult (*kMethod)(const IdData&)>
int read_step_response(Call& call) {
    call.at_most(1);
    auto result = std::make_shared<StepTestResult>(kMethod(object_argument<IdData>(call, 1, "data")));
    Estimate estimate;
    estimate.method = call.function_name();
    estimate.names = result->names;
    estimate.theta = result->parameters;
    estimate.message = result->message;
    for (const ReadingPoint& point : result->points) {
        estimate.fields.edit().numbers.emplace_back(point.name + " time", point.time);
        estimate.fields.edit().numbers.emplace_back(point.name + " value", point.value);
    }
    estimate.step_test = result;
    push_object(call.state(), Model{result->model, {}, std::make_shared<Estimate>(std::move(estimate))});
    return 1;
}

/// The readings of a step test drawn on the measured response.
int draw_construction(Call& call) {
    call.at_most(2);
    const Options options(call, 2, kConstruction);
    const Model model = model_argument(call, 1, "G");
    if (!model.estimate || !model.estimate->step_test)
        throw InvalidArgument(
            "{} must be a model returned by step_first_order, step_second_order or step_delayed, "
            "but another model was given",
            argument_label(1, "G"));
    const StepTestResult& test = *model.estimate->step_test;
    StepConstruction construction;
    construction.t = test.step_data.t;
    construction.y = test.step_data.y;
    construction.smoothed = test.step_data.smoothed;
    construction.step_time = test.step_data.step_time;
    construction.initial = test.step_data.initial.value;
    construction.final = test.step_data.final.value;
    for (const ReadingPoint& point : test.points)
        construction.readings.push_back({point.name, point.time, point.value});
    if (options.has("xlabel")) construction.x_label = Message::verbatim(options.text("xlabel", ""));
    construction.y_label = Message::verbatim(options.text("ylabel", ""));
    return give_figure(call, step_construction(construction));
}

int estimate_process_model(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const ProcessStructure structure = process_structure_argument(call, 2);
    ProcsrivcOptions requested;
    read_fit_options(Options(call, 3, kProcsrivc), requested);
    return give_diagnosed_fit(call, "procsrivc", procsrivc(data, structure, requested), requested);
}

constexpr const char* kStep = "step tests";
constexpr FunctionEntry kEstimatorsFunctions[] = {
    {"step_first_order", kStep, "step_first_order(data) -> G",
     marked("estimator", "Determine K/(1 + T s) from the gain and the 5 % settling time of a step response"),
     guarded<read_step_response<step_first_order>>, kNoOptions, kStepArguments},
    {"step_second_order", kStep, "step_second_order(data) -> G",
     marked("estimator",
            "Determine gain, damping ratio and natural frequency from the first overshoot of a step response"),
     guarded<read_step_response<step_second_order>>, kNoOptions, kStepArguments},
    {"step_delayed", kStep, "step_delayed(data) -> G",
     marked("estimator", "Determine K exp(-D s)/(1 + T s) from two points of a step response"),
     guarded<read_step_response<step_delayed>>, kNoOptions, kStepArguments},
    {"step_construction", kStep, "step_construction(G, {options}) -> fig",
     "Plot the graphical construction of a step test", guarded<draw_construction>, kConstruction,
     kConstructionArguments},
    {"procsrivc", "continuous time", "procsrivc(data, \"P2DU\", {options}) -> G",
     marked("estimator", "Estimate a process model by minimizing the simulation error"),
     guarded<memoized_call<estimate_process_model>>, kProcsrivc, kProcsrivcArguments},
};

}  // namespace

FunctionEntries estimator_functions() {
    return kEstimatorsFunctions;
}

}  // namespace dynlab::inline scripting
