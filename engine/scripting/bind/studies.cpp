#include <algorithm>

#include "data_io/values/cbor_values.h"
#include "data_io/values/estimate_descriptions.h"
#include "numerics/validation/monte_carlo.h"
#include "platform/terminal/progress.h"
#include "scripting/arguments/loop_arguments.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/estimation_readers.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/model.h"
#include "scripting/objects/study_objects.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kStudyOptions[] = {
    {"system", ValueKind::kModel, about("true continuous-time model")},
    {"input", ValueKind::kVector, about("samples of the input; required unless you specify `controller`")},
    {"controller", ValueKind::kModel,
     about("controller of a closed loop u = C (r - y), instead of `input`: a model, or a number")},
    {"reference", ValueKind::kVector, about("samples of the reference of the closed loop; required with `controller`")},
    {"ComputingDelay",
     ValueKind::kCount,
     about("delay of the controller in samples, for sampled controllers"),
     {.initial = "0"}},
    {"Ts", ValueKind::kNumber, about("sampling time; required"), {.unit = "s"}},
    option<&MonteCarloStudy::hold>("hold", kHoldOption.description, {.initial = "\"zoh\"", .choices = kHolds}),
    option<&MonteCarloStudy::sigma>("sigma", about("standard deviation of the noise; specify either `sigma` or `snr`"),
                                    {.minimum = 0}),
    option<&MonteCarloStudy::snr>("snr",
                                  about("signal-to-noise ratio 20 log10(std(x)/std(noise)), where x is the output "
                                        "without noise; instead of `sigma`"),
                                  {.unit = "dB"}),
    option<&MonteCarloStudy::runs>("runs", about("number of repeated experiments"), {.minimum = 2}),
    option<&MonteCarloStudy::seed>(
        "seed",
        about("seed of the noise: run k = 0, 1, ... adds the numbers that `randn` returns after `rng(seed + k)`"),
        {.maximum = kMaxSeed}),
    option<&MonteCarloStudy::threads>("threads", about("number of threads; 0 for all cores")),
    {"estimators", ValueKind::kTable,
     about("table of estimators. Each key is a label. Each entry is a table of the arguments that follow the data, or "
           "a function of the data")}};
constexpr OptionTable kStudyTables[] = {kStudyOptions};

MonteCarloEstimate estimate_in_study(const Fit& result) {
    return {result.theta, result.std, result.names, true, result.termination == Termination::kConverged};
}

struct MethodArguments {
    EstimationReader reader;
    Estimation estimation;
};

/// Runs in a separate stack frame, with the arguments in the places of a direct call of the method.
int read_arguments(Call& call) {
    auto* arguments = static_cast<MethodArguments*>(lua_touserdata(call.state(), lua_upvalueindex(2)));
    arguments->estimation = arguments->reader(call);
    return 0;
}

/// A method whose arguments after the data are the entries from `first` on of the table at `table`.
MonteCarloMethod method_of_table(const Call& call, const std::string& label, const std::string& name, int table,
                                 lua_Integer first) {
    lua_State* L = call.state();
    MethodArguments arguments{find_estimation_reader(name), {}};
    if (arguments.reader == nullptr)
        throw InvalidArgument(
            "unknown estimator '{}'; the estimators are {}. Use a function for other estimators: {} = function(data) "
            "return ... end",
            name, listed(estimation_names()), label);
    lua_pushlightuserdata(L, const_cast<char*>(name.c_str()));
    lua_pushlightuserdata(L, &arguments);
    lua_pushcclosure(L, guarded<read_arguments>, 2);
    lua_pushnil(L);  // the place of the data
    const auto last = static_cast<lua_Integer>(lua_rawlen(L, table));
    luaL_checkstack(L, static_cast<int>(std::max<lua_Integer>(last, 0)) + 4, "too many arguments of an estimator");
    for (lua_Integer i = first; i <= last; ++i) lua_rawgeti(L, table, i);
    lua_call(L, static_cast<int>(last - first + 2), 0);
    return {label, [estimation = std::move(arguments.estimation)](const IdData& data) {
                return estimate_in_study(estimation(data));
            }};
}

MonteCarloEstimate estimate_of_model(const Model& model) {
    const ModelParameters parameters = parameters_of(model);
    return {parameters.values, parameters.std, parameters.names, model.G.continuous(),
            !model.estimate || model.estimate->converged};
}

/// What a script's function returned: a model, or a vector of parameters with their standard errors.
MonteCarloEstimate returned_estimate(lua_State* L, int first) {
    const Call call(L);
    if (const Model* model = to_object<Model>(L, first)) return estimate_of_model(*model);
    if (!call.holds_vector(first))
        throw InvalidArgument("the function must return a model or a vector of parameters, but returned {}",
                              given_value(L, first));
    MonteCarloEstimate estimate{call.vector(first, "theta")};
    if (call.holds_vector(first + 1)) estimate.std = call.vector(first + 1, "std");
    return estimate;
}

/// A function of the script at a stack index, which stays there while the study runs.
MonteCarloMethod method_of_function(const Call& call, const std::string& label, int function) {
    lua_State* L = call.state();
    const auto estimate = [L, function](const IdData& data) {
        const int top = lua_gettop(L);
        luaL_checkstack(L, 8, "too many estimators");
        lua_pushvalue(L, function);
        push_object(L, data);
        if (lua_pcall(L, 1, 2, 0) != LUA_OK) {
            pass_stop_on(L);
            translate_value_on_top(L);
            const Message message = lua_type(L, -1) == LUA_TSTRING ? error_at(L, -1).with_place() : given_value(L, -1);
            lua_settop(L, top);
            throw InvalidArgument(message);
        }
        MonteCarloEstimate result = returned_estimate(L, top + 1);
        lua_settop(L, top);
        return result;
    };
    return {label, estimate, false};
}

/// Whether the method's second argument is a table of orders, as its signature says.
bool takes_orders(const Call& call, const std::string& method) {
    const auto& functions = call.context().functions;
    return std::ranges::any_of(functions, [&](const FunctionEntry* entry) {
        return entry->name == method && std::string_view(entry->signature).find("(data, {n") != std::string_view::npos;
    });
}

/// One entry of the estimators: its value is on top of the stack, and stays when it is a function.
MonteCarloMethod method_of_entry(const Call& call, const std::string& label) {
    lua_State* L = call.state();
    const int value = lua_gettop(L);
    if (lua_isfunction(L, value)) return method_of_function(call, label, value);
    if (!lua_istable(L, value))
        throw InvalidArgument(
            "{} must be {}, but {} was given", Message("the estimator '{}'", label),
            Message("a table of arguments, such as lssvf = {{2, 1, 0}, 3}, or a function of the data"),
            given_value(L, value));
    const bool names_itself = lua_rawgeti(L, value, 1) == LUA_TSTRING;
    const std::string name = names_itself ? lua_tostring(L, -1) : label;
    const bool holds_function = names_itself && lua_rawgeti(L, value, 2) == LUA_TFUNCTION;
    if (lua_rawgeti(L, value, names_itself ? 2 : 1) == LUA_TNUMBER && takes_orders(call, name))
        throw InvalidArgument(
            "the arguments of the estimator '{}' must be a table that contains the table of orders: {} = {{1, 1, 0}}",
            name, name);
    lua_settop(L, value + (holds_function ? 2 : 0));
    if (holds_function) return method_of_function(call, label.empty() ? name : label, lua_gettop(L));
    lua_settop(L, value);
    std::string shown = label.empty() ? name : label;
    if (lua_getfield(L, value, "label") == LUA_TSTRING) shown = lua_tostring(L, -1);
    lua_settop(L, value);
    MonteCarloMethod method = method_of_table(call, shown, name, value, names_itself ? 2 : 1);
    lua_settop(L, value - 1);
    return method;
}

/// The names of the table's named entries: known methods in the order of their list, then the others by name.
std::vector<std::string> entry_names(lua_State* L, int table) {
    std::vector<std::string> names;
    collect_text_keys(L, table, names);
    const std::vector<std::string> known = estimation_names();
    const auto rank = [&](const std::string& name) { return std::ranges::find(known, name) - known.begin(); };
    std::ranges::sort(names, [&](const std::string& a, const std::string& b) {
        return rank(a) != rank(b) ? rank(a) < rank(b) : a < b;
    });
    return names;
}

std::vector<MonteCarloMethod> methods_of(const Call& call, int table) {
    lua_State* L = call.state();
    if (!lua_istable(L, table))
        throw InvalidArgument(
            "option 'estimators' must be a table, such as {lssvf = {{2, 1, 0}, 3}, ivsvf = {{2, 1, 0}, 3}}, "
            "but {} was given",
            given_value(L, table));
    std::vector<MonteCarloMethod> methods;
    const auto length = static_cast<lua_Integer>(lua_rawlen(L, table));
    for (lua_Integer i = 1; i <= length; ++i) {
        luaL_checkstack(L, 16, "too many estimators");
        lua_rawgeti(L, table, i);
        methods.push_back(method_of_entry(call, lua_isfunction(L, -1) ? fmt::format("function {}", i) : ""));
    }
    for (const std::string& name : entry_names(L, table)) {
        luaL_checkstack(L, 16, "too many estimators");
        lua_getfield(L, table, name.c_str());
        methods.push_back(method_of_entry(call, name));
    }
    return methods;
}

TransferFunction system_of(const Options& options) {
    const Model* model = to_object<Model>(options.call().state(), options.push("system"));
    if (model == nullptr || !model->single_channel())
        throw InvalidArgument(
            "option 'system' must be a model with one input and one output, such as 2/(s^2 + 4*s + 3)");
    return model->G;
}

/// The input of an open loop, or controller and reference of a closed one.
void read_excitation(const Options& options, MonteCarloStudy& study) {
    const bool loop = options.has("controller");
    const char *name = loop ? "reference" : "input", *other = loop ? "input" : "reference";
    if (options.has(other))
        throw InvalidArgument(
            loop ? Message("in a closed loop, controller and reference determine the input; omit option 'input'")
                 : Message("option 'reference' applies only to a closed loop; specify option 'controller', "
                           "or omit 'reference'"));
    if (!options.has(name)) throw InvalidArgument("option '{}' is missing; specify the samples of the {}", name, name);
    study.u = options.vector(name);
    if (!loop) return;
    study.controller = controller_at(options.call(), options.push("controller"));
    study.controller->computing_delay = computing_delay_of(options);
}

MonteCarloStudy study_of(const Options& options) {
    MonteCarloStudy study;
    study.system = system_of(options);
    read_excitation(options, study);
    options.read(study);
    const auto Ts = options.optional_number("Ts");
    if (!Ts) throw InvalidArgument("option 'Ts' is missing; specify the sampling time in seconds");
    study.Ts = *Ts;
    study.cancel = options.call().cancel();
    return study;
}

/// Where the program makes calls in parts; each part has one core.
void make_in_parts(MonteCarloStudy& study, lua_State* L) {
    CallsInParts* const parts = context_of(L).services.parts;
    if (parts == nullptr) return;
    study.threads = 1;
    study.in_parts = [L, parts](std::size_t runs, const SomeRuns& some) {
        const auto bytes_of = [&](std::size_t first, std::size_t count) {
            const std::vector<MonteCarloRun> made = some(first, count);
            poll_stop(L);  // a part that was cut off is none
            return cbor_of(made);
        };
        std::vector<MonteCarloRun> all;
        for (const std::string& part : parts->all(context_of(L).recorder.record().files_read, runs, bytes_of))
            for (MonteCarloRun& run : from_cbor<std::vector<MonteCarloRun>>(part)) all.push_back(std::move(run));
        if (all.size() != runs)
            throw EnvironmentError(
                "the stored parts contain {} runs of montecarlo, but the script requests {}; compute the parts again",
                all.size(), runs);
        return all;
    };
}

int run_study(Call& call) {
    call.at_most(1);
    const Options options(call, 1, kStudyTables);
    MonteCarloStudy study = study_of(options);
    const std::vector<MonteCarloMethod> methods = methods_of(call, options.push("estimators"));
    make_in_parts(study, call.state());
    ProgressBar bar("Monte Carlo", static_cast<std::size_t>(study.runs) * methods.size());
    study.progress = [&bar](std::size_t done) { bar.advance(done); };
    MonteCarlo result = monte_carlo(study, methods);
    poll_stop(call.state());
    push_object(call.state(), std::move(result));
    return 1;
}

constexpr FunctionEntry kStudiesFunctions[] = {
    {"montecarlo", "validation", "montecarlo{options} -> M",
     "Repeat an experiment with new noise to determine the bias and scatter of estimators",
     guarded<memoized_call<run_study>>, kStudyTables},
};

}  // namespace

FunctionEntries study_functions() {
    return kStudiesFunctions;
}

}  // namespace dynlab::inline scripting
