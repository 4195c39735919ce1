#include <algorithm>

#include "figures/plots/monte_carlo_plot.h"
#include "figures/plots/profile_plot.h"
#include "numerics/validation/intervals/bootstrap.h"
#include "numerics/validation/intervals/profile_likelihood.h"
#include "platform/terminal/progress.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kBootstrapKinds = {"residual", "parametric"};
constexpr std::array kBootstrapOptions = {
    option<&BootstrapOptions::runs>("runs", about("number of repeated experiments"), {.minimum = 20, .member = "runs"}),
    option<&BootstrapOptions::kind>("kind",
                                    about("noise of each run: residuals drawn with replacement (\"residual\"), or "
                                          "normally distributed noise (\"parametric\")"),
                                    {.initial = "\"residual\"", .choices = kBootstrapKinds}),
    option<&BootstrapOptions::seed>("seed", about("seed of the noise"), {.maximum = kMaxSeed}),
    option<&BootstrapOptions::confidence>("confidence", about("confidence level of the intervals"),
                                          {.member = "confidence"})};
constexpr OptionEntry kProfileOptions[] = {
    option<&ProfileOptions::confidence>("confidence", about("confidence level of the interval"),
                                        {.member = "confidence"}),
    option<&ProfileOptions::points>("points", about("number of points of the grid"),
                                    {.minimum = 5, .member = "points"}),
    {"range",
     ValueKind::kVector,
     about("limits {low, high} of the grid; by default, four standard errors on each side of the estimate, or more if "
           "the interval is wider"),
     {.member = "range"}}};
constexpr OptionTable kBootstrapTables[] = {kBootstrapOptions, kSimulationStart},
                      kProfileTables[] = {kProfileOptions, kSimulationStart};

constexpr ArgumentEntry
    kEstimateArgument = {"G", ValueKind::kModel,
                         about("model with one input and one output, estimated by `procsrivc`, `tfsrivc`, `tfrivc`, "
                               "`srivc`, `rivc`, `coe` or `tfcoe`, without `Integration`")},
    kItsDataArgument = {"data", ValueKind::kData, about("data object from which the model was estimated")};
constexpr std::array kBootstrapArguments = {kEstimateArgument, kItsDataArgument};
constexpr ArgumentEntry kProfileArguments[] = {
    kEstimateArgument,
    kItsDataArgument,
    {"name", ValueKind::kText, about("name of a parameter of the model, such as \"Td\"; `G.names` lists them")}};

/// A model that an output-error method left, or a sentence why it is none.
const Model& output_error_argument(const Call& call, int index) {
    const Model* model = index <= call.count() ? to_object<Model>(call.state(), index) : nullptr;
    const char* const function = call.function_name();
    if (model == nullptr) wrong_argument(call.state(), index, "G", with_article("model"));
    const Message instead = Message(
        "{} requires a model estimated by minimization of the simulation error. Estimate the model with procsrivc, "
        "tfsrivc, tfrivc, srivc, rivc, coe or tfcoe, without option 'Integration'",
        function);
    if (!model->estimate) throw InvalidArgument("the model was specified, not estimated; {}", instead);
    const Estimate& estimate = *model->estimate;
    if (!model->single_channel())
        throw InvalidArgument("{} requires a model with one input and one output, but {}", function,
                              channels_hint(*model));
    const bool process = model->process.has_value();
    if (estimate.carx || model->polynomial || model->system || !model->G.continuous() ||
        (!process && !estimate.of_coefficients))
        throw InvalidArgument("this model, estimated by {}, is not suitable; {}", estimate.method, instead);
    return *model;
}

/// A model does not contain the initial state of the data: the function estimates it again as compare does.
FittedOutput fitted_argument(const Call& call, int index, const IdData& data, const CompareOptions& options) {
    const Model& model = output_error_argument(call, index);
    FittedOutput fitted;
    fitted.start = compare_all(data, {model.G}, options).results.front().front().start;
    if (model.process) {
        fitted.process = model.process->structure;
        fitted.theta = model.process->parameters;
        if (fitted.process->integrator && fitted.start.state != InitialState::kZero)
            fitted.start = {InitialState::kEstimate, false};
        return fitted;
    }
    const std::vector<std::string>& names = model.estimate->names;
    const bool free_delay = std::find(names.begin(), names.end(), "Td") != names.end();
    fitted.structure = TransferStructure::single(static_cast<int>(model.G.pole_count()),
                                                 static_cast<int>(model.G.num().size()) - 1, model.G.delay());
    fitted.structure.free_delays = free_delay;
    fitted.theta = model.estimate->theta.head(fitted.structure.parameter_count());
    return fitted;
}

/// The study in the form that histograms take, with the estimate as the true value.
MonteCarlo as_study(const Bootstrap& found, int runs) {
    MonteCarloResult result;
    result.label = "bootstrap";
    for (Index i = 0; i < found.estimate.size(); ++i)
        if (found.values.col(i).array().isFinite().any() && std::isfinite(found.estimate[i]))
            result.names.push_back(found.names[static_cast<std::size_t>(i)]);
    result.theta.resize(found.values.rows(), static_cast<Index>(result.names.size()));
    result.truth.resize(result.theta.cols());
    for (Index i = 0, j = 0; i < found.estimate.size() && j < result.theta.cols(); ++i) {
        if (found.names[static_cast<std::size_t>(i)] != result.names[static_cast<std::size_t>(j)]) continue;
        result.theta.col(j) = found.values.col(i);
        result.truth[j++] = found.estimate[i];
    }
    result.estimated = runs - found.failed;
    MonteCarlo study;
    study.runs = runs;
    study.results = {std::move(result)};
    return study;
}

int repeat_experiment(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 2, "data");
    const Options options(call, 3, kBootstrapTables);
    BootstrapOptions requested;
    options.read(requested);
    requested.cancel = call.cancel();
    ProgressBar bar("bootstrap", static_cast<std::size_t>(requested.runs));
    requested.progress = [&bar](std::size_t done) { bar.advance(done); };
    const RefittedOutput model(data, fitted_argument(call, 1, data, compare_options(options)));
    const Bootstrap found = bootstrap(model, requested);
    call.print(localized(call, found.message) + "\n");
    give_figure(call, monte_carlo_histograms(as_study(found, requested.runs)));
    give_table(call, "names", found.names, "estimate", found.estimate, "values", found.values, "mean", found.mean,
               "std", found.std, "low", found.low, "high", found.high, "failed", found.failed, "message",
               localized(call, found.message), "warnings", localized(call, found.warnings));
    return 2;
}

std::string unit_of(const IdData& data, const std::string& parameter) {
    const bool time = parameter.starts_with("T");
    return time ? data.time_unit : "";
}

int follow_parameter(Call& call) {
    call.at_most(4);
    const IdData& data = object_argument<IdData>(call, 2, "data");
    const std::string name = call.text(3, "parameter");
    const Options options(call, 4, kProfileTables);
    ProfileOptions requested;
    options.read(requested);
    requested.range = options.range("range");
    requested.cancel = call.cancel();
    const RefittedOutput model(data, fitted_argument(call, 1, data, compare_options(options)));
    const Profile found = profile_likelihood(model, name, requested);
    call.print(localized(call, found.message) + "\n");
    give_figure(call, profile_plot(found, unit_of(data, name)));
    give_table(call, "estimate", found.estimate, "std", found.std, "low", found.low, "high", found.high, "level",
               found.level, "grid", found.grid, "rise", found.rise, "message", localized(call, found.message),
               "warnings", localized(call, found.warnings));
    return 2;
}

constexpr FunctionEntry kIntervalFunctions[] = {
    {"bootstrap", "validation", "bootstrap(G, data, {options}) -> fig, table",
     "Compute confidence intervals for parameters, gain and time constants by repeated simulation",
     guarded<memoized_call<repeat_experiment>>, kBootstrapTables, kBootstrapArguments},
    {"profile", "validation", "profile(G, data, name, {options}) -> fig, table",
     "Compute the profile-likelihood interval of one parameter", guarded<memoized_call<follow_parameter>>,
     kProfileTables, kProfileArguments},
};

}  // namespace

FunctionEntries interval_functions() {
    return kIntervalFunctions;
}

}  // namespace dynlab::inline scripting
