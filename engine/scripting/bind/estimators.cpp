#include <array>

#include "figures/step_construction.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/estimators/step_test.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

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
        estimate.numbers.emplace_back(point.name + " time", point.time);
        estimate.numbers.emplace_back(point.name + " value", point.value);
    }
    estimate.step_test = result;
    push_object(call.state(), Model{result->model, {}, std::make_shared<Estimate>(std::move(estimate))});
    return 1;
}

/// The readings of a step test drawn on the measured response.
int draw_construction(Call& call) {
    call.at_most(2);
    const Options options(call, 2, {"xlabel", "ylabel"});
    const Model model = model_argument(call, 1, "G");
    if (!model.estimate || !model.estimate->step_test)
        throw InvalidArgument(
            "argument 1 (G) must be a model that step_first_order, step_second_order or step_delayed gave");
    const StepTestResult& test = *model.estimate->step_test;
    StepConstruction construction;
    construction.t = test.record.t;
    construction.y = test.record.y;
    construction.smoothed = test.record.smoothed;
    construction.step_time = test.record.step_time;
    construction.initial = test.record.initial.value;
    construction.final = test.record.final.value;
    for (const ReadingPoint& point : test.points)
        construction.readings.push_back({point.name, point.time, point.value});
    construction.x_label = options.text("xlabel", construction.x_label);
    construction.y_label = options.text("ylabel", "");
    return give_figure(call, step_construction(construction));
}

ProcsrivcOptions procsrivc_options(const Call& call, int index) {
    const Options options(call, index, {"InitialState", "Offset", "TdMin", "TdMax", "NumTd", "MaxIter", "Tol"});
    ProcsrivcOptions wanted;
    wanted.initial_state = parse_initial_state(options.text("InitialState", "auto"));
    wanted.offset = parse_offset(options.text("Offset", "auto"));
    wanted.TdMin = options.number("TdMin", wanted.TdMin);
    wanted.TdMax = options.optional_number("TdMax");
    wanted.NumTd = static_cast<int>(options.size("NumTd", wanted.NumTd));
    wanted.MaxIter = static_cast<int>(options.size("MaxIter", wanted.MaxIter));
    wanted.Tol = options.number("Tol", wanted.Tol);
    wanted.cancel = call.cancel();
    return wanted;
}

Estimate estimate_of(const ProcsrivcResult& result) {
    Estimate estimate = common_estimate("procsrivc", result);
    estimate.numbers = {{"fit_percent", result.fit_percent},
                        {"noise_variance", result.noise_variance},
                        {"loss", result.loss},
                        {"offset", result.offsets[0]},
                        {"iterations", static_cast<double>(result.trace.size())}};
    estimate.vectors = {{"output", result.output},
                        {"initial_values", result.initial_values.empty() ? Vector() : result.initial_values.front()},
                        {"offsets", result.offsets},
                        {"delay_grid", result.delay_grid},
                        {"delay_loss", result.delay_loss}};
    return estimate;
}

int estimate_process_model(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const ProcessStructure structure = ProcessStructure::parse(call.text(2, "structure"));
    const ProcsrivcResult result = procsrivc(data, structure, procsrivc_options(call, 3));
    Estimate estimate = estimate_of(result);
    estimate.assessment = std::make_shared<Assessment>(assess(data, result));
    push_object(call.state(),
                Model{result.model.transfer_function(), result.model, std::make_shared<Estimate>(std::move(estimate))});
    return 1;
}

constexpr const char* kStep = "step tests";
constexpr std::array kEstimatorsFunctions = {
    FunctionEntry{"step_first_order", kStep, "step_first_order(data) -> G",
                  "K/(1 + T s) read off a step response: gain and 5 % settling time",
                  guarded<read_step_response<step_first_order>>},
    FunctionEntry{"step_second_order", kStep, "step_second_order(data) -> G",
                  "gain, damping and natural frequency read off the first overshoot",
                  guarded<read_step_response<step_second_order>>},
    FunctionEntry{"step_delayed", kStep, "step_delayed(data) -> G",
                  "K exp(-D s)/(1 + T s) from two points of a step response",
                  guarded<read_step_response<step_delayed>>},
    FunctionEntry{"step_construction", kStep, "step_construction(G, {xlabel =, ylabel =}) -> fig",
                  "the reading points of a step test on its response", guarded<draw_construction>},
    FunctionEntry{"procsrivc", "continuous time",
                  "procsrivc(data, \"P2DU\", {TdMin =, TdMax =, InitialState =, Offset =, ...}) -> G",
                  "process model with the smallest simulation error", guarded<memoized_call<estimate_process_model>>},
};

}  // namespace

FunctionEntries estimator_functions() {
    return kEstimatorsFunctions;
}

}  // namespace dynlab::inline scripting
