#include <array>

#include "numerics/rigs/crane_experiments.h"
#include "numerics/rigs/first_order_step.h"
#include "numerics/rigs/heat_exchanger.h"
#include "numerics/rigs/suspension.h"
#include "scripting/bindings.h"
#include "scripting/objects/boxed.h"

namespace dynlab {
namespace {

using Columns = std::initializer_list<std::pair<const char*, const Vector*>>;
using Numbers = std::initializer_list<std::pair<const char*, double>>;

void give_columns(const Call& call, Columns columns) {
    lua_createtable(call.state(), 0, static_cast<int>(columns.size()));
    for (const auto& [name, values] : columns) {
        call.give_vector(*values);
        lua_setfield(call.state(), -2, name);
    }
}

void give_numbers(const Call& call, Numbers numbers) {
    lua_createtable(call.state(), 0, static_cast<int>(numbers.size()));
    for (const auto& [name, value] : numbers) {
        lua_pushnumber(call.state(), value);
        lua_setfield(call.state(), -2, name);
    }
}

void give_record(const Call& call, const RigRecord& record) {
    give_columns(call, {{"t", &record.t}, {"u", &record.u}, {"y", &record.y}});
}

void crane_record(const Call& call, std::uint32_t seed) {
    const std::vector<CraneRecord> records = simulate_crane({}, {}, seed);
    lua_createtable(call.state(), 0, static_cast<int>(records.size()));
    for (const CraneRecord& record : records) {
        give_columns(call, {{"t", &record.t}, {"u", &record.u}, {"x", &record.x}, {"theta", &record.theta}});
        lua_setfield(call.state(), -2, record.name.c_str());
    }
}

void crane_theory(const Call& call) {
    const CraneTruth truth = crane_truth({});
    give_numbers(call, {{"natural_frequency", truth.natural_frequency},
                        {"damping_ratio", truth.damping_ratio},
                        {"speed_gain", truth.speed_gain},
                        {"dry_voltage", truth.dry_voltage},
                        {"starting_voltage", truth.starting_voltage},
                        {"time_constant", truth.time_constant}});
}

void heat_exchanger_record(const Call& call, std::uint32_t seed) {
    give_record(call, simulate_heat_exchanger({}, seed));
}

void heat_exchanger_theory(const Call& call) {
    const HeatExchangerTruth truth = heat_exchanger_truth({});
    give_numbers(call, {{"gain", truth.gain},
                        {"time_constant", truth.time_constant},
                        {"output_at_zero_input", truth.output_at_zero_input},
                        {"initial_output", truth.initial_output},
                        {"final_output", truth.final_output}});
}

void step_response_record(const Call& call, std::uint32_t seed) {
    const FirstOrderStepRecord record = simulate_first_order_step({}, seed);
    give_columns(call, {{"t", &record.t},
                        {"u", &record.u},
                        {"y", &record.y},
                        {"ydot", &record.ydot},
                        {"y_noisy", &record.y_noisy},
                        {"ydot_noisy", &record.ydot_noisy}});
}

void step_response_theory(const Call& call) {
    const FirstOrderStepTruth truth = first_order_step_truth({});
    give_numbers(call, {{"a", truth.a}, {"b", truth.b}, {"f", truth.f}, {"g", truth.g}});
}

void suspension_record(const Call& call, std::uint32_t seed) {
    give_record(call, simulate_suspension({}, seed));
}

void suspension_theory(const Call& call) {
    const SuspensionTruth truth = suspension_truth({});
    give_numbers(call, {{"gain", truth.gain},
                        {"natural_frequency", truth.natural_frequency},
                        {"damping_ratio", truth.damping_ratio},
                        {"overshoot", truth.overshoot},
                        {"overshoot_time", truth.overshoot_time}});
}

/// An experiment: both functions push one table.
struct Rig {
    std::string_view name;
    void (*record)(const Call& call, std::uint32_t seed);
    void (*theory)(const Call& call);
};

constexpr std::array kRigs = {
    Rig{"crane", crane_record, crane_theory},
    Rig{"heat_exchanger", heat_exchanger_record, heat_exchanger_theory},
    Rig{"step_response", step_response_record, step_response_theory},
    Rig{"suspension", suspension_record, suspension_theory},
};

const Rig& rig_of(const Call& call) {
    const std::string name = call.text(1, "name");
    for (const Rig& rig : kRigs)
        if (rig.name == name) return rig;
    std::vector<std::string_view> names;
    for (const Rig& rig : kRigs) names.push_back(rig.name);
    throw InvalidArgument(fmt::format("there is no experiment '{}'; there are {}", name, fmt::join(names, ", ")));
}

/// rig(name, {seed =}): the course's experiments, with the parameters their headers state.
int rig(Call& call) {
    call.at_most(2);
    const Options options(call, 2, {"seed"});
    const Index seed = options.size("seed", 1);
    if (seed > 0xFFFFFFFF) throw InvalidArgument("option 'seed' must be a whole number from 0 to 4294967295");
    rig_of(call).record(call, static_cast<std::uint32_t>(seed));
    return 1;
}

int rig_truth(Call& call) {
    call.at_most(1);
    rig_of(call).theory(call);
    return 1;
}

constexpr std::array kFunctions = {
    FunctionEntry{"rig", "data", "rig(name, {seed =}) -> table",
                  "repeats one of the course's simulated experiments, with other noise for another seed", guarded<rig>},
    FunctionEntry{"rig_truth", "data", "rig_truth(name) -> table",
                  "what theory says of one of the course's simulated experiments", guarded<rig_truth>},
};

}  // namespace

FunctionEntries rig_functions() {
    return kFunctions;
}

}  // namespace dynlab
