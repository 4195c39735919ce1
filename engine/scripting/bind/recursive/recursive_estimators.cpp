#include <array>

#include "base/catalog.h"
#include "figures/plots/history_plot.h"
#include "numerics/estimators/recursive/rivsvf.h"
#include "numerics/estimators/recursive/rlssvf.h"
#include "numerics/estimators/recursive/rsrivc.h"
#include "numerics/fit/simulation_error.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/estimation_readers.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kRecursiveEquationOrders = {kNa, kNb, kNk};
constexpr std::array kRecursiveOutputOrders = {kNb, kNf, kNk};

constexpr std::array kRecursiveOptions = {
    option<&RecursiveOptions::forgetting>(
        "forgetting", about("forgetting factor, which multiplies the weights of all past samples at each new sample; "
                            "greater than 0 and at most 1; 1 for no forgetting")),
    OptionEntry{"drift", ValueKind::kVector,
                about("variances of the random steps of the parameters from one sample to the next, one number for all "
                      "or one per parameter. By default, no steps")},
    option<&RecursiveOptions::noise_variance>(
        "NoiseVariance",
        about("noise variance, used only with `drift`: the ratio of `drift` to this variance determines how fast the "
              "estimates change. By default, computed from the past errors"),
        {.member = "noise_variance"}),
    option<&RecursiveOptions::history_points>(
        "HistoryPoints", about("maximum number of equally spaced instants in the history, including the last sample"),
        {.minimum = 1, .member = "history_points"}),
    OptionEntry{"model", ValueKind::kModel,
                about("fixed model for filters and instruments (rivsvf and rsrivc), instead of the current estimate")},
    kHoldOfOutput<RecursiveOptions>};
constexpr std::array kHistoryOptions = {
    OptionEntry{"truth", ValueKind::kTable,
                about("true parameters by name: numbers, or vectors of values at equally spaced instants from the "
                      "first sample to the last, such as {a1 = 4, b0 = linspace(2, 3, 100)}")},
    OptionEntry{"confidence", ValueKind::kNumber, about("confidence level of the bands"), {.initial = "0.95"}}};
constexpr OptionTable kRecursive[] = {kRecursiveOptions}, kHistory[] = {kHistoryOptions};

constexpr ArgumentEntry kRecursiveData = {
    "data", ValueKind::kData,
    about("data object with one experiment, one input and one output, regularly or irregularly sampled")};
constexpr std::array kRecursiveEquationArguments = {
    kRecursiveData,
    ArgumentEntry{
        "orders", ValueKind::kOrders,
        about("na poles (at most 8), nb coefficients of B (at most na + 1), and an input delay of nk samples")},
    kFilterFrequency};
constexpr std::array kRecursiveOutputArguments = {
    kRecursiveData,
    ArgumentEntry{
        "orders", ValueKind::kOrders,
        about("nb coefficients of B (at most nf + 1), nf poles (at most 8), and an input delay of nk samples")},
    kFilterFrequency};
constexpr std::array kHistoryArguments = {
    ArgumentEntry{"G", ValueKind::kModel, about("model returned by rlssvf, rivsvf or rsrivc")}};

/// One number for all parameters or one for each, taken as variances of steps from sample to sample.
Vector drift_of(const Options& options) {
    if (!options.has("drift")) return Vector();
    const int index = options.push("drift");
    if (lua_type(options.call().state(), index) == LUA_TNUMBER) return Vector::Constant(1, options.number("drift", 0));
    return options.vector("drift");
}

TransferFunction fixed_model(const Options& options) {
    const Model* const model = to_object<Model>(options.call().state(), options.push("model"));
    if (model == nullptr || !model->single_channel())
        throw InvalidArgument(
            "option 'model' must be a model with one input and one output, such as srivc(data, {1, 2, 0})");
    return model->G;
}

RecursiveOptions recursive_options(const Call& call, const Options& options) {
    RecursiveOptions requested;
    requested.lambda = call.number(3, "lambda");
    options.read(requested);
    requested.drift = drift_of(options);
    if (options.has("model")) requested.model = fixed_model(options);
    requested.cancel = call.cancel();
    return requested;
}

template <auto kMethod, bool kCarx>
Estimation read_recursive(const Call& call) {
    call.at_most(4);
    const auto& entries = kCarx ? kRecursiveEquationOrders : kRecursiveOutputOrders;
    const auto orders = order_lists(call, 2, entries);
    const Options options(call, 4, kRecursive);
    return [structure = structure_of_orders(entries, orders, Denominators::kPerOutput),
            requested = recursive_options(call, options)](const IdData& data) {
        const TransferStructure of_data = structure(data);
        RecursiveOptions own = requested;
        if (own.drift.size() == 1) own.drift = Vector::Constant(of_data.parameter_count(), own.drift[0]);
        return kMethod(data, of_data, own);
    };
}

template <auto kMethod, bool kCarx>
int estimate_recursively(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    Fit result = read_recursive<kMethod, kCarx>(call)(data);
    measure_simulation(result, data);
    return give_fit(call, call.function_name(), result, kCarx ? FitForm::kEquationError : FitForm::kOutputError);
}

/// A number or a vector for each parameter that has a name in the table.
std::map<std::string, Vector> truth_of(const Options& options) {
    std::map<std::string, Vector> truth;
    if (!options.has("truth")) return truth;
    lua_State* L = options.call().state();
    const int index = options.push("truth");
    if (lua_type(L, index) != LUA_TTABLE)
        throw InvalidArgument("option 'truth' must be a table such as {a1 = 4, b0 = v}, but {} was given",
                              given_value(L, index));
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING)
            throw InvalidArgument("option 'truth' must contain named values, such as {a1 = 4, b0 = v}");
        const std::string name = lua_tostring(L, -2);
        if (lua_type(L, -1) == LUA_TNUMBER)
            truth[name] = Vector::Constant(1, lua_tonumber(L, -1));
        else if (NumericBlock* values = to_vector(L, -1))
            truth[name] = values->vector();
        else
            throw InvalidArgument("option 'truth' must contain numbers or vectors, but {} is {}", name,
                                  given_value(L, -1));
    }
    return truth;
}

int plot_parameters(Call& call) {
    call.at_most(2);
    const Model& model = object_argument<Model>(call, 1, "G");
    const Options options(call, 2, kHistory);
    if (!model.estimate || !model.estimate->history)
        throw InvalidArgument("this model has no history: use rlssvf, rivsvf or rsrivc");
    const double level = options.number("confidence", 0.95);
    if (!(level > 0 && level < 1))
        refuse_option("confidence", Message("a confidence level between 0 and 1"),
                      Message("{}", significant(level, 10)));
    return give_figure(call, history_plot(*model.estimate->history, model.estimate->names, truth_of(options), level));
}

constexpr NamedReader kRecursiveReaders[] = {{"rlssvf", read_recursive<rlssvf, true>},
                                             {"rivsvf", read_recursive<rivsvf, true>},
                                             {"rsrivc", read_recursive<rsrivc, false>}};

constexpr FunctionEntry kRecursiveFunctions[] = {
    {"rlssvf", "continuous time", "rlssvf(data, {na, nb, nk}, lambda, {options}) -> G",
     marked("estimator", "Estimate time-varying parameters with a recursive form of lssvf"),
     guarded<memoized_call<estimate_recursively<rlssvf, true>>>, kRecursive, kRecursiveEquationArguments},
    {"rivsvf", "continuous time", "rivsvf(data, {na, nb, nk}, lambda, {options}) -> G",
     marked("estimator", "Estimate time-varying parameters with a recursive form of ivsvf"),
     guarded<memoized_call<estimate_recursively<rivsvf, true>>>, kRecursive, kRecursiveEquationArguments},
    {"rsrivc", "continuous time", "rsrivc(data, {nb, nf, nk}, lambda, {options}) -> G",
     marked("estimator", "Estimate time-varying parameters with a recursive form of srivc"),
     guarded<memoized_call<estimate_recursively<rsrivc, false>>>, kRecursive, kRecursiveOutputArguments},
    {"plot_history", "figures", "plot_history(G, {options}) -> fig",
     "Plot parameters versus time with confidence bands", guarded<plot_parameters>, kHistory, kHistoryArguments},
};

}  // namespace

EstimationReaders recursive_readers() {
    return kRecursiveReaders;
}

FunctionEntries recursive_functions() {
    return kRecursiveFunctions;
}

}  // namespace dynlab::inline scripting
