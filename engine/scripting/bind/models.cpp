#include <algorithm>
#include <array>
#include <functional>

#include "numerics/models/convert.h"
#include "numerics/simulation/stability_margins.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/grey_object.h"
#include "scripting/objects/model.h"
#include "scripting/objects/present.h"
#include "scripting/objects/process_structure.h"
#include "scripting/objects/simulated_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kModelPeriod = {
    "Ts", ValueKind::kNumber, about("sampling time; by default, the model is a continuous-time model"), {.unit = "s"}};
constexpr OptionEntry kTfOptions[] = {kModelPeriod,
                                      {"IODelay",
                                       ValueKind::kNumber,
                                       about("delay; for a discrete-time model, a multiple of `Ts`"),
                                       {.initial = "0", .unit = "s"}}};
constexpr OptionEntry kIdprocOptions[] = {
    {"Kp", ValueKind::kNumber, about("gain")},
    {"Tp1", ValueKind::kNumber, about("first time constant"), {.unit = "s"}},
    {"Tp2", ValueKind::kNumber, about("second time constant"), {.unit = "s"}},
    {"Tp3", ValueKind::kNumber, about("third time constant"), {.unit = "s"}},
    {"Tw",
     ValueKind::kNumber,
     about("time constant 1/w0 of the underdamped poles (U), where w0 is the natural frequency in rad/s"),
     {.unit = "s"}},
    {"Zeta", ValueKind::kNumber, about("damping ratio of the underdamped poles (U)")},
    {"Tz", ValueKind::kNumber, about("time constant of the zero (Z)"), {.unit = "s"}},
    {"Td", ValueKind::kNumber, about("delay (D)"), {.unit = "s"}}};
constexpr std::array kSsOptions = {kModelPeriod};
constexpr OptionTable kTfTables[] = {kTfOptions}, kIdprocTables[] = {kIdprocOptions}, kSsTables[] = {kSsOptions};

constexpr std::array kModelAlone = {kOneChannelModel};
constexpr ArgumentEntry kTfArguments[] = {
    {"num", ValueKind::kVector,
     about(
         "coefficients of the numerator, highest power first; or, as the only argument, a table with the fields `num` "
         "and `den`, and optionally `Ts` and `IODelay`. `load` returns this table for a model that `save_mat` or "
         "`save_json` wrote")},
    {"den", ValueKind::kVector, about("coefficients of the denominator, highest power first")}};
constexpr ArgumentEntry kIdprocArguments[] = {
    {"structure", ValueKind::kProcess, about("name of the structure, such as \"P1\", \"P2U\", \"P1D\" or \"P2DU\"")}};
constexpr ArgumentEntry kSsArguments[] = {
    {"A", ValueKind::kAny, about("state matrix of the system: n x n for n states")},
    {"B", ValueKind::kAny, about("input matrix of the system: n x m for n states and m inputs")},
    {"C", ValueKind::kAny, about("output matrix of the system: p x n for n states and p outputs")},
    {"D", ValueKind::kAny, about("feedthrough matrix of the system: p x m for m inputs and p outputs")},
    {"G", ValueKind::kModel, about("transfer function, instead of the matrices")}};
constexpr ArgumentEntry
    kEqualTimes = {"G1, G2", ValueKind::kModel, about("models with equal sampling times")},
    kEqualDelays = {"G1, G2", ValueKind::kModel,
                    about("models with the same sampling time; continuous-time models must also have the same delay")};
constexpr std::array kSeriesArguments = {kEqualTimes}, kParallelArguments = {kEqualDelays};
constexpr ArgumentEntry kFeedbackArguments[] = {
    {"forward, backward", ValueKind::kModel,
     about("models; a number is a gain, and delays of discrete-time models become poles at z = 0")},
    {"sign", ValueKind::kNumber, about("-1 (negative feedback, the default) or 1")}};
constexpr ArgumentEntry kPadeArguments[] = {
    {"G", ValueKind::kModel, about("model; in discrete time, the delay is replaced exactly by poles at z = 0")},
    {"n", ValueKind::kCount, about("number of poles, 1 to 10")}};
constexpr ArgumentEntry kConversion = {"method", ValueKind::kChoice,
                                       about("\"zoh\" (the default), \"foh\" or \"tustin\"")};
constexpr ArgumentEntry kDiscreteArguments[] = {
    {"G", ValueKind::kModel, about("continuous-time transfer function or state-space model")},
    {"Ts", ValueKind::kNumber, about("sampling time in seconds")},
    kConversion};
constexpr ArgumentEntry kContinuousArguments[] = {
    {"Gd", ValueKind::kModel, about("discrete-time transfer function to convert")}, kConversion};
constexpr ArgumentEntry kPresentArguments[] = {{"G, ...", ValueKind::kModel, about("one or several models")}};
constexpr ArgumentEntry kLoopArguments[] = {{"G", ValueKind::kModel, about("open-loop model")}};

/// Pushes a field of a struct, which may be one that load() gave: these refuse names they have not.
int push_field(lua_State* L, int index, const char* name) {
    lua_pushstring(L, name);
    return lua_rawget(L, index);
}

/// A field of a struct: a number, a vector, a list of numbers, or a matrix of one row.
Vector coefficients_of_field(const Call& call, int index, const char* name) {
    lua_State* L = call.state();
    if (push_field(L, index, name) == LUA_TTABLE)
        make_vector_of_table(L, lua_gettop(L), Message("the field {} of a model table", name));
    NumericBlock* block = to_vector(L, -1) != nullptr ? to_vector(L, -1) : to_matrix(L, -1);
    Vector values;
    if (lua_type(L, -1) == LUA_TNUMBER)
        values = Vector::Constant(1, lua_tonumber(L, -1));
    else if (block != nullptr && std::min(block->rows, block->columns) == 1)
        values = Eigen::Map<const Vector>(block->data(), block->rows * block->columns);
    else
        throw InvalidArgument("the field {} of a model table must be a vector, but it is {}", name,
                              given_value(L, lua_gettop(L)));
    lua_pop(L, 1);
    return values;
}

double number_of_field(const Call& call, int index, const char* name) {
    lua_State* L = call.state();
    const int type = push_field(L, index, name);
    if (type != LUA_TNIL && type != LUA_TNUMBER)
        throw InvalidArgument("the field {} of a model table must be a number, but it is {}", name,
                              given_value(L, lua_gettop(L)));
    const double value = type == LUA_TNIL ? 0 : lua_tonumber(L, -1);
    lua_pop(L, 1);
    return value;
}

/// Whether the argument is a struct as save_mat and save_json write it of a model.
bool holds_model_struct(const Call& call) {
    if (call.type(1) != LUA_TTABLE) return false;
    bool both = true;
    for (const char* name : {"num", "den"}) {
        both = push_field(call.state(), 1, name) != LUA_TNIL && both;
        lua_pop(call.state(), 1);
    }
    return both;
}

/// tf("s"), tf("z", Ts), tf(struct), tf(num, den, {...}), tf(num, den, Ts, {...}), tf(system)
int make_tf(Call& call) {
    call.at_most(call.type(3) == LUA_TNUMBER ? 4 : 3);
    if (call.type(1) == LUA_TSTRING) {
        const std::string name = call.text(1, "variable");
        if (name == "s") return give_model(call, TransferFunction::variable());
        if (name == "z" && call.given(2)) return give_model(call, TransferFunction::variable(call.number(2, "Ts")));
        throw InvalidArgument("write the variable as tf(\"s\"), or tf(\"z\", Ts) with the sampling time in seconds");
    }
    if (holds_model(call, 1)) return give_model(call, model_argument(call, 1, "model").G);
    if (holds_model_struct(call)) {
        call.at_most(1);
        const Vector num = coefficients_of_field(call, 1, "num"), den = coefficients_of_field(call, 1, "den");
        return give_model(
            call, TransferFunction(num, den, number_of_field(call, 1, "Ts"), number_of_field(call, 1, "IODelay")));
    }
    const bool sampled = call.type(3) == LUA_TNUMBER;  // tf(num, den, Ts)
    const Options options(call, sampled ? 4 : 3, kTfTables);
    auto coefficients = [&](int index, ArgumentName what) {
        return call.type(index) == LUA_TNUMBER ? Vector(Vector::Constant(1, call.number(index, what)))
                                               : Vector(call.vector(index, what));
    };
    const double Ts = sampled ? call.number(3, "Ts") : options.number("Ts", 0);
    return give_model(
        call, TransferFunction(coefficients(1, "num"), coefficients(2, "den"), Ts, options.number("IODelay", 0)));
}

int make_idproc(Call& call) {
    call.at_most(2);
    const ProcessStructure structure = ProcessStructure::parse(call.text(1, "structure"));
    if (!call.given(2)) {
        push_object(call.state(), ProcessStructure(structure));
        return 1;
    }
    const Options options(call, 2, kIdprocTables);
    const std::vector<std::string> names = structure.parameter_names();
    Vector parameters(static_cast<Index>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto value = options.optional_number(names[i].c_str());
        if (!value)
            throw InvalidArgument("the structure {} needs the parameters {}; {} is missing", structure.text(),
                                  listed(names), names[i]);
        parameters[static_cast<Index>(i)] = *value;
    }
    const ProcessModel process(structure, parameters);
    push_object(call.state(), Model{process.transfer_function(), process, {}});
    return 1;
}

/// ss(A, B, C, D, {Ts =}) or ss(G)
int make_ss(Call& call) {
    call.at_most(5);
    if (holds_model(call, 1)) {
        const Model* model = to_object<Model>(call.state(), 1);
        if (model != nullptr && model->system) {
            push_object(call.state(), StateSpace(*model->system));
            return 1;
        }
        push_object(call.state(), to_state_space(with_rational_delay("ss", model_argument(call, 1, "G").G)));
        return 1;
    }
    const Options options(call, 5, kSsTables);
    push_object(call.state(), StateSpace(call.matrix(1, "A"), call.matrix(2, "B"), call.matrix(3, "C"),
                                         call.matrix(4, "D"), options.number("Ts", 0)));
    return 1;
}

int connect_series(Call& call) {
    call.at_most(2);
    return give_model(call, model_argument(call, 1, "G1").G * model_argument(call, 2, "G2").G);
}
int connect_parallel(Call& call) {
    call.at_most(2);
    return give_model(call, model_argument(call, 1, "G1").G + model_argument(call, 2, "G2").G);
}
int connect_feedback(Call& call) {
    call.at_most(3);
    const Index sign = call.given(3) ? call.integer(3, "sign") : -1;
    if (sign != 1 && sign != -1)
        throw InvalidArgument("the sign must be -1 (negative feedback) or 1 (positive feedback), but {} was given",
                              sign);
    const auto part = [&](int index, ArgumentName what) {
        return with_rational_delay("feedback", model_argument(call, index, what).G);
    };
    return give_model(call, feedback(part(1, "forward"), part(2, "backward"), static_cast<int>(sign)));
}
int replace_delay(Call& call) {
    call.at_most(2);
    return give_model(call, pade(model_argument(call, 1, "G").G, static_cast<int>(call.integer(2, "n"))));
}

Discretization method_argument(const Call& call, int index) {
    const std::string name = call.given(index) ? call.text(index, "method") : "zoh";
    if (name == "zoh") return Discretization::kZoh;
    if (name == "foh") return Discretization::kFoh;
    if (name == "tustin") return Discretization::kTustin;
    throw InvalidArgument("the method must be \"zoh\", \"foh\" or \"tustin\", but \"{}\" was given", name);
}

int to_discrete(Call& call) {
    call.at_most(3);
    const double Ts = call.number(2, "Ts");
    const Discretization method = method_argument(call, 3);
    if (const StateSpace* system = to_object<StateSpace>(call.state(), 1)) {
        push_object(call.state(), c2d(*system, Ts, method));
        return 1;
    }
    return give_model(call, c2d(model_argument(call, 1, "G").G, Ts, method));
}
int to_continuous(Call& call) {
    call.at_most(2);
    return give_model(call, d2c(model_argument(call, 1, "G").G, method_argument(call, 2)));
}

/// kGet of the transfer function, the only argument.
template <auto kGet>
int of_model(Call& call) {
    call.at_most(1);
    return give_value(call, std::invoke(kGet, model_argument(call, 1, "G").G));
}

/// gain margin, phase margin (degrees), their frequencies (rad/s), delay margin (s)
int margins(Call& call) {
    call.at_most(1);
    const StabilityMargins found = stability_margins(model_argument(call, 1, "G").G);
    for (const double value :
         {found.gain_margin, found.phase_margin, found.gain_frequency, found.phase_frequency, found.delay_margin})
        call.give(value);
    return 5;
}

/// natural frequencies, damping ratios, time constants
int damp(Call& call) {
    call.at_most(1);
    const auto rows = damping(model_argument(call, 1, "G").G);
    const auto count = static_cast<Index>(rows.size());
    Matrix columns(count, 3);
    for (Index i = 0; i < count; ++i) {
        const PoleDescription& row = rows[static_cast<std::size_t>(i)];
        columns.row(i) << row.natural_frequency, row.damping_ratio, row.time_constant;
    }
    for (Index j = 0; j < 3; ++j) call.give_vector(columns.col(j));
    return 3;
}

int present(Call& call) {
    if (call.count() == 0) wrong_argument(call.state(), 1, "G", with_article("model"));
    for (int i = 1; i <= call.count(); ++i) {
        if (const GreyEstimate* grey = to_object<GreyEstimate>(call.state(), i)) {
            call.print(grey_presentation(**grey, reader_of(call)));
            continue;
        }
        if (const SimulatedModel* simulated = simulated_model(call, i)) {
            call.print(presentation(*simulated, reader_of(call)));
            continue;
        }
        const Model* model = to_object<Model>(call.state(), i);
        call.print(presentation(model != nullptr ? *model : model_argument(call, i, "G"), reader_of(call)));
    }
    return 0;
}

constexpr FunctionEntry kModelsFunctions[] = {
    {"tf", "models", "tf(num, den, {options}) -> G; tf(\"s\"); tf(\"z\", Ts)",
     "Create a transfer function, or the variable s or z for writing transfer functions", guarded<make_tf>, kTfTables,
     kTfArguments},
    {"idproc", "models", "idproc(\"P1D\", {options}) -> G; idproc(\"P1D\")",
     "Create a process model from gain, time constants and delay", guarded<make_idproc>, kIdprocTables,
     kIdprocArguments},
    {"ss", "models", "ss(A, B, C, D, {options}) -> system; ss(G)", "Create a state-space model", guarded<make_ss>,
     kSsTables, kSsArguments},
    {"series", "models", "series(G1, G2) -> G", "Connect two models in series", guarded<connect_series>, kNoOptions,
     kSeriesArguments},
    {"parallel", "models", "parallel(G1, G2) -> G", "Connect two models in parallel", guarded<connect_parallel>,
     kNoOptions, kParallelArguments},
    {"feedback", "models", "feedback(forward, backward, sign) -> G", "Close a loop, with negative feedback by default",
     guarded<connect_feedback>, kNoOptions, kFeedbackArguments},
    {"pade", "models", "pade(G, n) -> Gp",
     "Approximate the delay of a model by a rational transfer function with n poles", guarded<replace_delay>,
     kNoOptions, kPadeArguments},
    {"c2d", "models", "c2d(G, Ts, \"zoh\" | \"foh\" | \"tustin\") -> Gd",
     "Convert a continuous-time model to discrete time", guarded<to_discrete>, kNoOptions, kDiscreteArguments},
    {"d2c", "models", "d2c(Gd, \"zoh\" | \"foh\" | \"tustin\") -> G",
     "Convert a discrete-time model to continuous time", guarded<to_continuous>, kNoOptions, kContinuousArguments},
    {"pole", "models", "pole(G) -> p", "Poles of a model", guarded<of_model<&TransferFunction::poles>>, kNoOptions,
     kModelAlone},
    {"zero", "models", "zero(G) -> z", "Zeros of a model", guarded<of_model<&TransferFunction::zeros>>, kNoOptions,
     kModelAlone},
    {"dcgain", "models", "dcgain(G) -> K", "Steady-state gain", guarded<of_model<&TransferFunction::dc_gain>>,
     kNoOptions, kModelAlone},
    {"damp", "models", "damp(G) -> wn, zeta, T", "Natural frequency, damping ratio and time constant of every pole",
     guarded<damp>, kNoOptions, kModelAlone},
    {"bandwidth", "models", "bandwidth(G) -> w", "Frequency (rad/s) at which the gain is 3 dB below its dc value",
     guarded<of_model<bandwidth>>, kNoOptions, kModelAlone},
    {"stable", "models", "stable(G) -> true or false", "Test whether all poles are stable",
     guarded<of_model<&TransferFunction::stable>>, kNoOptions, kModelAlone},
    {"margin", "models", "margin(G) -> Gm, Pm, Wcg, Wcp, Dm", "Gain, phase and delay margins of the open-loop model G",
     guarded<margins>, kNoOptions, kLoopArguments},
    {"present", "models", "present(G, ...)", "Print the properties and estimation results of models", guarded<present>,
     kNoOptions, kPresentArguments},
};

}  // namespace

FunctionEntries model_functions() {
    return kModelsFunctions;
}

}  // namespace dynlab::inline scripting
