#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "base/reader.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/grey_box/script_equations.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/grey_object.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kIdgreyOptions = {
    OptionEntry{"states", ValueKind::kAny, about("names of the states, or their number; by default the length of x0")},
    OptionEntry{"outputs",
                ValueKind::kAny,
                about("function(t, x, u, p) that returns a table of outputs; by default, output i is equal to state i"),
                {.member = "outputs"}},
    OptionEntry{"x0",
                ValueKind::kAny,
                about("initial state: a number, a parameter name or \"estimate\" for each state, or one of these "
                      "values for all states; or function(p) that returns a table. By default, zero"),
                {.initial = "0"}},
    OptionEntry{"inputs", ValueKind::kCount,
                about("number of inputs; required if the function is not symbolic and the model does not have exactly "
                      "one input")}};
constexpr OptionTable kIdgrey[] = {kIdgreyOptions};
constexpr std::array kIdgreyArguments = {
    ArgumentEntry{
        "f", ValueKind::kAny,
        about("function(t, x, u, p) that returns a table with one derivative for each state, or function(p) that "
              "returns the matrices A, B, C, D of a linear model")},
    ArgumentEntry{"parameters", ValueKind::kTable,
                  about("parameters by name, each an initial value or {start, min =, max =, fixed = true}")}};

/// k2 before k10.
bool comes_before(const std::string& a, const std::string& b) {
    const auto number_begin = [](const std::string& name) {
        std::size_t i = name.size();
        while (i > 0 && name[i - 1] >= '0' && name[i - 1] <= '9') --i;
        return i;
    };
    const std::size_t i = number_begin(a), j = number_begin(b);
    if (a.compare(0, i, b, 0, j) != 0) return a < b;
    if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
    return a < b;
}

double number_field(lua_State* L, const std::string& name, const char* field, double fallback) {
    const int type = lua_getfield(L, -1, field);
    if (type != LUA_TNIL && type != LUA_TNUMBER)
        throw InvalidArgument("the field '{}' of the parameter {} must be {}, but {} was given", field, name,
                              Message("a number"), given_value(L, -1));
    const double value = type == LUA_TNIL ? fallback : lua_tonumber(L, -1);
    lua_pop(L, 1);
    return value;
}

bool fixed_field(lua_State* L, const std::string& name) {
    const int type = lua_getfield(L, -1, "fixed");
    if (type != LUA_TNIL && type != LUA_TBOOLEAN)
        throw InvalidArgument("the field '{}' of the parameter {} must be {}, but {} was given", "fixed", name,
                              Message("true or false"), given_value(L, -1));
    const bool value = lua_toboolean(L, -1) != 0;
    lua_pop(L, 1);
    return value;
}

void check_fields(lua_State* L, const std::string& name) {
    for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1)) {
        const std::string key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : message_text(given_value(L, -2));
        if (key != "1" && key != "min" && key != "max" && key != "fixed")
            throw InvalidArgument(
                "the parameter {} must be written as {start, min =, max =, fixed =}; '{}' is not one of these fields",
                name, key);
    }
}

/// The value on top: a number, or {start, min =, max =, fixed =}.
GreyParameter parameter_on_top(lua_State* L, const std::string& name) {
    GreyParameter parameter{name};
    if (lua_type(L, -1) == LUA_TNUMBER) {
        parameter.start = lua_tonumber(L, -1);
        return parameter;
    }
    if (!lua_istable(L, -1))
        throw InvalidArgument(
            "the parameter {} must be {start, min =, max =, fixed =} or its initial value, but {} was given", name,
            given_value(L, -1));
    check_fields(L, name);
    if (lua_rawgeti(L, -1, 1) != LUA_TNUMBER)
        throw InvalidArgument("the parameter {} needs a number as its initial value, such as {1.5, min = 0}", name);
    parameter.start = lua_tonumber(L, -1);
    lua_pop(L, 1);
    parameter.lower = number_field(L, name, "min", parameter.lower);
    parameter.upper = number_field(L, name, "max", parameter.upper);
    parameter.fixed = fixed_field(L, name);
    return parameter;
}

std::vector<GreyParameter> parameters_argument(const Call& call, int index) {
    lua_State* L = call.state();
    if (call.type(index) != LUA_TTABLE)
        wrong_argument(L, index, "parameters", Message("a table such as {k1 = {0.5, min = 0}, k2 = 1}"));
    std::vector<GreyParameter> parameters;
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING)
            throw InvalidArgument("{} must have a name for each entry, as in {k1 = {0.5, min = 0}, k2 = 1}",
                                  argument_label(2, "parameters"));
        parameters.push_back(parameter_on_top(L, lua_tostring(L, -2)));
    }
    std::sort(parameters.begin(), parameters.end(),
              [](const GreyParameter& a, const GreyParameter& b) { return comes_before(a.name, b.name); });
    return parameters;
}

/// Names, or how many there are: x1, x2, ...; without the option as many as x0 has entries.
std::vector<std::string> states_option(const Options& options) {
    lua_State* L = options.call().state();
    const int place = options.push("states"), type = lua_type(L, place);
    lua_Integer count = 0;
    if (type == LUA_TNUMBER) {
        count = static_cast<lua_Integer>(options.size("states", 0));
    } else if (type == LUA_TNIL && lua_istable(L, options.push("x0"))) {
        count = static_cast<lua_Integer>(lua_rawlen(L, -1));
    }
    lua_settop(L, place - 1);
    if (type != LUA_TNIL && type != LUA_TNUMBER) return options.texts("states");
    if (count < 1)
        throw InvalidArgument(
            "the model needs at least one state. Specify option 'states' (names such as {\"h1\", \"h2\"}, or a "
            "number), or option 'x0' with one value per state");
    std::vector<std::string> names;
    for (lua_Integer i = 1; i <= count; ++i) names.push_back(fmt::format("x{}", i));
    return names;
}

/// Entries of the option x0: numbers, names of parameters, or "estimate".
void read_entry(const Call& call, ScriptEquations& equations, GreyModel& model, Index state) {
    lua_State* L = call.state();
    InitialEntry& entry = equations.initial_entries[static_cast<std::size_t>(state)];
    if (lua_type(L, -1) == LUA_TNUMBER) {
        entry.value = lua_tonumber(L, -1);
        return;
    }
    const std::string word = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
    if (word == "estimate") {
        model.estimated_initial[static_cast<std::size_t>(state)] = true;
        return;
    }
    const auto& names = equations.parameters;
    const auto found = std::find(names.begin(), names.end(), word);
    if (word.empty() || found == names.end())
        throw InvalidArgument(
            "option 'x0' must have a number, the name of a parameter or \"estimate\" for each state, but {} was given; "
            "the parameters are {}",
            given_value(L, -1), listed(names));
    entry.parameter = found - names.begin();
}

void read_initial_state(const Options& options, ScriptEquations& equations, GreyModel& model) {
    const auto n = static_cast<Index>(equations.states.size());
    equations.initial_entries.assign(static_cast<std::size_t>(n), {});
    model.estimated_initial.assign(static_cast<std::size_t>(n), false);
    lua_State* L = options.call().state();
    const int place = options.push("x0");
    if (lua_isfunction(L, place)) {
        equations.initial = std::make_shared<ScriptFunction>(L, place);
    } else if (lua_type(L, place) == LUA_TSTRING || lua_type(L, place) == LUA_TNUMBER) {
        for (Index i = 0; i < n; ++i) read_entry(options.call(), equations, model, i);
    } else if (!lua_isnil(L, place)) {
        if (lua_istable(L, place) == 0 || static_cast<Index>(lua_rawlen(L, place)) != n)
            refuse_option("x0",
                          Message("a table of {} (one for each state), \"estimate\", or a function of p",
                                  plural(n, "{} value", "{} values")),
                          lua_istable(L, place) != 0 ? plural(static_cast<std::int64_t>(lua_rawlen(L, place)),
                                                              "a table of {} value", "a table of {} values")
                                                     : given_value(L, place));
        for (Index i = 0; i < n; ++i) {
            lua_rawgeti(L, place, i + 1);
            read_entry(options.call(), equations, model, i);
            lua_pop(L, 1);
        }
    }
    lua_settop(L, place - 1);
}

std::shared_ptr<ScriptFunction> function_option(const Options& options, const char* name) {
    lua_State* L = options.call().state();
    const int place = options.push(name);
    if (!lua_isnil(L, place) && !lua_isfunction(L, place))
        refuse_option(name, Message("a function(t, x, u, p)"), given_value(L, place));
    auto function = lua_isnil(L, place) ? nullptr : std::make_shared<ScriptFunction>(L, place);
    lua_settop(L, place - 1);
    return function;
}

/// Whether the function takes p alone: it gives the matrices of a state-space model.
bool takes_one_argument(lua_State* L, int index) {
    lua_Debug about;
    lua_pushvalue(L, index);
    return lua_getinfo(L, ">u", &about) != 0 && about.nparams == 1 && about.isvararg == 0;
}

int make_grey_model(Call& call) {
    call.at_most(3);
    if (call.type(1) != LUA_TFUNCTION)
        wrong_argument(call.state(), 1, "f",
                       Message("a function(t, x, u, p) that returns the derivatives of the states"));
    const Options options(call, 3, kIdgrey);
    GreyModel model;
    ScriptEquations equations;
    model.parameters = parameters_argument(call, 2);
    for (const GreyParameter& parameter : model.parameters) equations.parameters.push_back(parameter.name);
    model.state_names = equations.states = states_option(options);
    model.validate();
    equations.rates = std::make_shared<ScriptFunction>(call.state(), 1);
    equations.of_matrices = takes_one_argument(call.state(), 1);
    equations.outputs = function_option(options, "outputs");
    equations.inputs = options.size("inputs", -1);
    model.outputs_are_states = !equations.outputs && !equations.of_matrices;
    read_initial_state(options, equations, model);

    Message reason;
    std::optional<TracedFunctions> traced = trace_functions(equations, reason);
    if (traced && equations.inputs < 0) equations.inputs = traced->inputs;
    CalledFunctions called = call_functions(equations, model.start());
    if (traced && !agree(*traced, called, model.start())) {
        reason = Message(
            "the function returns different results when it is called again, or it branches on the values of its "
            "arguments, for instance with ==");
        traced.reset();
    }
    model.inputs = traced ? traced->inputs : called.inputs;
    if (!traced)
        call.print_lines(localized(call, Message("idgrey calls the function for each evaluation, which takes about a "
                                                 "hundred times as long as a symbolic function.")) +
                         "\n(" + localized(call, reason) + ")\n");
    model.equations = traced ? traced_equations(std::move(*traced)) : called_equations(std::move(called));
    push_object(call.state(), std::move(model));
    return 1;
}

std::string model_text(const GreyModel& model, const Reader& reader) {
    MessageList properties;
    properties.items.push_back(plural(model.order(), "grey-box model with {} state ({})",
                                      "grey-box model with {} states ({})", listed(model.state_names)));
    properties.items.push_back(plural(model.inputs, "{} input", "{} inputs"));
    properties.items.push_back(model.outputs_are_states
                                   ? Message("output i equal to state i")
                                   : plural(model.equations->output_count(), "{} output", "{} outputs"));
    if (model.equations->is_linear()) properties.items.push_back(Message("linear"));
    std::string text = message_text(Message("{}", properties), reader) + "\n";
    for (const GreyParameter& p : model.parameters) {
        text += fmt::format("  {:<8} {:>12}", p.name, number_text(significant(p.start, 6), reader));
        if (p.fixed) text += "  " + message_text(Message("fixed"), reader);
        if (std::isfinite(p.lower)) text += "  " + message_text(Message("from {}", p.lower), reader);
        if (std::isfinite(p.upper)) text += "  " + message_text(Message("to {}", p.upper), reader);
        text += "\n";
    }
    return text;
}

std::vector<std::string> parameter_names(const GreyModel& model) {
    std::vector<std::string> names;
    for (const GreyParameter& p : model.parameters) names.push_back(p.name);
    return names;
}

constexpr std::array kGreyModelFields = {Member{"names", field<GreyModel, parameter_names>},
                                         Member{"states", field<GreyModel, &GreyModel::state_names>},
                                         Member{"start", field<GreyModel, &GreyModel::start>}};
constexpr std::array kGreyModelOperators = {Member{"__tostring", localized_field<GreyModel, model_text>}};

constexpr FunctionEntry kIdgreyFunctions[] = {
    {"idgrey", "grey box", "idgrey(f, {p1 = {start, min =, max =, fixed =}, ...}, {options}) -> m",
     "Create a model of differential equations with unknown parameters", guarded<make_grey_model>, kIdgrey,
     kIdgreyArguments},
};

constexpr std::array kIdgreyTypes = {TypeEntry{&Userdata<GreyModel>::type, kGreyModelFields, {}, kGreyModelOperators}};

}  // namespace

TypeEntries idgrey_types() {
    return kIdgreyTypes;
}

FunctionEntries idgrey_functions() {
    return kIdgreyFunctions;
}

}  // namespace dynlab::inline scripting
