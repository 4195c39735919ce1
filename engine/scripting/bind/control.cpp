#include <array>

#include "numerics/control/state_feedback.h"
#include "numerics/plants/crane_control.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/conversions/userdata.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kCraneOptions[] = {
    option<&CraneRun::duration>("duration", about("duration of the run"), {.unit = "s"}),
    option<&CraneRun::position>("position", about("initial position of the trolley, from -0.5 to 0.5"), {.unit = "m"}),
    option<&CraneRun::angle>("angle", about("initial angle of the load"), {.unit = "rad"}),
    {"seed", ValueKind::kCount, about("seed of the sensor noise"), {.initial = "1", .maximum = kMaxSeed}}};
constexpr OptionTable kCraneTables[] = {kCraneOptions};

constexpr ArgumentEntry kStateMatrix = {"A", ValueKind::kAny, about("state matrix of the system: n x n for n states")};
constexpr ArgumentEntry kRegulatorArguments[] = {
    kStateMatrix,
    {"B", ValueKind::kAny, about("input matrix of the system: n x m for n states and m inputs")},
    {"Q", ValueKind::kAny, about("state weighting matrix: n x n for n states, symmetric positive semidefinite")},
    {"R", ValueKind::kAny, about("input weighting matrix: m x m for m inputs, symmetric positive definite")}};
constexpr ArgumentEntry kPlacementArguments[] = {
    kStateMatrix,
    {"B", ValueKind::kAny, about("input matrix of the system: n x 1, because the system must have one input")},
    {"poles", ValueKind::kAny,
     about("list of n poles, or a complex vector. In a list, {re, im} is "
           "a complex conjugate pair and counts as two poles")}};
constexpr ArgumentEntry kCraneArguments[] = {
    {"controller", ValueKind::kAny,
     about("function of time (s), measured position (m) and measured angle (rad) that returns a voltage (V)")}};

int give_feedback(const Call& call, const StateFeedback& feedback) {
    call.give_matrix(feedback.K);
    push_object(call.state(), ComplexVector(feedback.poles));
    return 2;
}

int lqr(Call& call) {
    call.at_most(4);
    return give_feedback(call, linear_quadratic_regulator(call.matrix(1, "A"), call.matrix(2, "B"), call.matrix(3, "Q"),
                                                          call.matrix(4, "R")));
}

/// A list of numbers and of pairs {re, im}; each pair means re + i im and re - i im.
ComplexVector listed_poles(const Call& call, int index) {
    lua_State* L = call.state();
    if (lua_type(L, index) != LUA_TTABLE)
        wrong_argument(L, index, "poles", Message("a list of numbers and pairs {re, im}, or a complex vector"));
    std::vector<Complex> poles;
    for (lua_Integer i = 1; lua_rawgeti(L, index, i) != LUA_TNIL; lua_pop(L, 1), ++i) {
        if (lua_type(L, -1) == LUA_TNUMBER) {
            poles.emplace_back(lua_tonumber(L, -1));
            continue;
        }
        if (lua_type(L, -1) != LUA_TTABLE || lua_rawlen(L, -1) != 2)
            throw InvalidArgument("poles must be numbers, or complex conjugate pairs {re, im}, but entry {} is {}", i,
                                  given_value(L, -1));
        lua_rawgeti(L, -1, 1);
        lua_rawgeti(L, -2, 2);
        if (lua_type(L, -1) != LUA_TNUMBER || lua_type(L, -2) != LUA_TNUMBER)
            throw InvalidArgument(
                "the two parts of a complex pole {re, im} must be numbers, but entry {} has {} and {}", i,
                given_value(L, -2), given_value(L, -1));
        poles.emplace_back(lua_tonumber(L, -2), lua_tonumber(L, -1));
        lua_pop(L, 2);
        poles.push_back(std::conj(poles.back()));
    }
    lua_pop(L, 1);
    return Eigen::Map<ComplexVector>(poles.data(), static_cast<Index>(poles.size()));
}

int place(Call& call) {
    call.at_most(3);
    const ComplexVector* given = to_object<ComplexVector>(call.state(), 3);
    return give_feedback(
        call, pole_placement(call.matrix(1, "A"), call.matrix(2, "B"), given ? *given : listed_poles(call, 3)));
}

/// drive_crane(controller, {...}): the controller is the script's function, called with t, x and theta.
int drive_crane(Call& call) {
    call.at_most(2);
    lua_State* L = call.state();
    if (call.type(1) != LUA_TFUNCTION) wrong_argument(L, 1, "controller", Message("a function of t, x and theta"));
    const Options options(call, 2, kCraneTables);
    CraneRun run;
    options.read(run);
    const auto controller = [L](double t, double x, double theta) {
        lua_pushvalue(L, 1);
        for (const double value : {t, x, theta}) lua_pushnumber(L, value);
        lua_call(L, 3, 1);
        if (lua_type(L, -1) != LUA_TNUMBER)
            throw InvalidArgument("the controller must return the voltage, a number, but returned {}",
                                  given_value(L, -1));
        const double voltage = lua_tonumber(L, -1);
        lua_pop(L, 1);
        return voltage;
    };
    const CraneData data_set =
        control_crane({}, {}, run, controller, static_cast<std::uint32_t>(options.whole("seed", 1)));
    return give_table(call, "t", data_set.t, "u", data_set.u, "x", data_set.x, "theta", data_set.theta);
}

constexpr FunctionEntry kControlFunctions[] = {
    {"lqr", "control", "lqr(A, B, Q, R) -> K, poles", "Design a linear-quadratic state feedback", guarded<lqr>,
     kNoOptions, kRegulatorArguments},
    {"place", "control", "place(A, B, poles) -> K, p", "Place the poles of a system with one input", guarded<place>,
     kNoOptions, kPlacementArguments},
    {"drive_crane", "control", "drive_crane(controller, {options}) -> table",
     "Test a controller on the simulated crane of the course", guarded<drive_crane>, kCraneTables, kCraneArguments},
};

}  // namespace

FunctionEntries control_functions() {
    return kControlFunctions;
}

}  // namespace dynlab::inline scripting
