#include <array>

#include "numerics/rigs/crane_experiments.h"
#include "numerics/rigs/specimen.h"
#include "scripting/arguments/table_fields.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/boxed.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

using Columns = std::initializer_list<std::pair<const char*, const Vector*>>;
using Numbers = std::initializer_list<std::pair<const char*, double>>;

void give_columns(const Call& call, Columns columns) {
    lua_createtable(call.state(), 0, static_cast<int>(columns.size()));
    for (const auto& [name, values] : columns) set_vector(call, name, *values);
}

void give_numbers(const Call& call, Numbers numbers) {
    lua_createtable(call.state(), 0, static_cast<int>(numbers.size()));
    for (const auto& [name, value] : numbers) set_number(call.state(), name, value);
}

void give_record(const Call& call, const RigRecord& record) {
    give_columns(call, {{"t", &record.t}, {"u", &record.u}, {"y", &record.y}});
}

void crane_record(const Call& call, std::uint32_t seed, std::uint32_t specimen) {
    const std::vector<CraneRecord> records = simulate_crane(crane_specimen(specimen), {}, seed);
    lua_createtable(call.state(), 0, static_cast<int>(records.size()));
    for (const CraneRecord& record : records) {
        give_columns(call, {{"t", &record.t}, {"u", &record.u}, {"x", &record.x}, {"theta", &record.theta}});
        refuse_unknown_fields(call.state(), "crane." + record.name);
        lua_setfield(call.state(), -2, record.name.c_str());
    }
}

void crane_theory(const Call& call, std::uint32_t specimen) {
    const CraneTruth truth = crane_truth(crane_specimen(specimen));
    give_numbers(call, {{"natural_frequency", truth.natural_frequency},
                        {"damping_ratio", truth.damping_ratio},
                        {"speed_gain", truth.speed_gain},
                        {"dry_voltage", truth.dry_voltage},
                        {"starting_voltage", truth.starting_voltage},
                        {"time_constant", truth.time_constant}});
}

void heat_exchanger_record(const Call& call, std::uint32_t seed, std::uint32_t specimen) {
    give_record(call, simulate_heat_exchanger(heat_exchanger_specimen(specimen), seed));
}

void heat_exchanger_theory(const Call& call, std::uint32_t specimen) {
    const HeatExchangerTruth truth = heat_exchanger_truth(heat_exchanger_specimen(specimen));
    give_numbers(call, {{"gain", truth.gain},
                        {"time_constant", truth.time_constant},
                        {"output_at_zero_input", truth.output_at_zero_input},
                        {"initial_output", truth.initial_output},
                        {"final_output", truth.final_output}});
}

void heat_transfer_record(const Call& call, std::uint32_t seed, std::uint32_t specimen) {
    const auto [estimation, validation, high] = simulate_heat_transfer(heat_transfer_specimen(specimen), {}, seed);
    give_columns(call, {{"t", &estimation.t},
                        {"u", &estimation.u},
                        {"y", &estimation.y},
                        {"t_val", &validation.t},
                        {"u_val", &validation.u},
                        {"y_val", &validation.y},
                        {"t_high", &high.t},
                        {"u_high", &high.u},
                        {"y_high", &high.y}});
}

void heat_transfer_theory(const Call& call, std::uint32_t specimen) {
    const HeatTransferParameters rig = heat_transfer_specimen(specimen);
    const HeatTransferExperiments plan;
    give_numbers(call, {{"dead_time", rig.dead_time}, {"sensor_time", rig.sensor_time}});
    for (const auto& [name, voltage] : {std::pair("low", plan.low), std::pair("high", plan.high)}) {
        const HeatTransferTruth truth = heat_transfer_truth(rig, voltage);
        give_numbers(call, {{"voltage", voltage},
                            {"temperature", truth.temperature},
                            {"gain", truth.gain},
                            {"slow", truth.slow},
                            {"fast", truth.fast}});
        lua_setfield(call.state(), -2, name);
    }
}

void linear_system_record(const Call& call, std::uint32_t seed, std::uint32_t specimen) {
    const auto [estimation, validation] = simulate_linear_system(linear_system_specimen(specimen), seed);
    give_columns(call, {{"t", &estimation.t},
                        {"u", &estimation.u},
                        {"y", &estimation.y},
                        {"t_val", &validation.t},
                        {"u_val", &validation.u},
                        {"y_val", &validation.y}});
}

void linear_system_theory(const Call& call, std::uint32_t specimen) {
    const LinearSystemParameters p = linear_system_specimen(specimen);
    give_numbers(call, {{"noise_std", p.noise_std}});
    give_model(call, linear_system_truth(p));
    lua_setfield(call.state(), -2, "G");
}

void step_response_record(const Call& call, std::uint32_t seed, std::uint32_t specimen) {
    const FirstOrderStepRecord record = simulate_first_order_step(step_response_specimen(specimen), seed);
    give_columns(call, {{"t", &record.t},
                        {"u", &record.u},
                        {"y", &record.y},
                        {"ydot", &record.ydot},
                        {"y_noisy", &record.y_noisy},
                        {"ydot_noisy", &record.ydot_noisy}});
}

void step_response_theory(const Call& call, std::uint32_t specimen) {
    const FirstOrderStepTruth truth = first_order_step_truth(step_response_specimen(specimen));
    give_numbers(call, {{"a", truth.a}, {"b", truth.b}, {"f", truth.f}, {"g", truth.g}});
}

void suspension_record(const Call& call, std::uint32_t seed, std::uint32_t specimen) {
    give_record(call, simulate_suspension(suspension_specimen(specimen), seed));
}

void suspension_theory(const Call& call, std::uint32_t specimen) {
    const SuspensionTruth truth = suspension_truth(suspension_specimen(specimen));
    give_numbers(call, {{"gain", truth.gain},
                        {"natural_frequency", truth.natural_frequency},
                        {"damping_ratio", truth.damping_ratio},
                        {"overshoot", truth.overshoot},
                        {"overshoot_time", truth.overshoot_time}});
}

void thruster_record(const Call& call, std::uint32_t seed, std::uint32_t specimen) {
    const std::vector<ThrusterRecord> records = simulate_thruster(thruster_specimen(specimen), {}, seed);
    lua_createtable(call.state(), 0, static_cast<int>(records.size()));
    for (const ThrusterRecord& record : records) {
        give_columns(call, {{"t", &record.t}, {"pwm", &record.pwm}, {"force", &record.force}});
        refuse_unknown_fields(call.state(), "thruster." + record.name);
        lua_setfield(call.state(), -2, record.name.c_str());
    }
}

void thruster_theory(const Call& call, std::uint32_t specimen) {
    const ThrusterParameters p = thruster_specimen(specimen);
    const ThrusterTruth truth = thruster_truth(p);
    const Vector pwm = Vector::LinSpaced(81, p.neutral - p.full_width, p.neutral + p.full_width);
    const Vector thrust = pwm.unaryExpr([&p](double width) { return thruster_thrust(p, width); });
    give_numbers(call, {{"delay", truth.delay},
                        {"neutral", p.neutral},
                        {"dead_band", p.dead_band},
                        {"forward_thrust", truth.forward_thrust},
                        {"reverse_thrust", truth.reverse_thrust},
                        {"slow_time_constant", truth.slow_time_constant},
                        {"fast_time_constant", truth.fast_time_constant},
                        {"cell_frequency", p.cell_frequency},
                        {"cell_damping", p.cell_damping}});
    set_vector(call, "pwm", pwm);
    set_vector(call, "thrust", thrust);
}

/// An experiment: both functions push one table.
struct Rig {
    std::string_view name;
    void (*record)(const Call& call, std::uint32_t seed, std::uint32_t specimen);
    void (*theory)(const Call& call, std::uint32_t specimen);
};

constexpr std::array kRigs = {
    Rig{"crane", crane_record, crane_theory},
    Rig{"heat_exchanger", heat_exchanger_record, heat_exchanger_theory},
    Rig{"heat_transfer", heat_transfer_record, heat_transfer_theory},
    Rig{"linear_system", linear_system_record, linear_system_theory},
    Rig{"step_response", step_response_record, step_response_theory},
    Rig{"suspension", suspension_record, suspension_theory},
    Rig{"thruster", thruster_record, thruster_theory},
};

const Rig& rig_of(const Call& call) {
    const std::string name = call.text(1, "name");
    for (const Rig& rig : kRigs)
        if (rig.name == name) return rig;
    std::vector<std::string_view> names;
    for (const Rig& rig : kRigs) names.push_back(rig.name);
    throw InvalidArgument(fmt::format("there is no experiment '{}'; there are {}", name, fmt::join(names, ", ")));
}

std::uint32_t small_number(const Options& options, const char* name, Index fallback) {
    const Index number = options.size(name, fallback);
    if (number > 0xFFFFFFFF)
        throw InvalidArgument(fmt::format("option '{}' must be a whole number from 0 to 4294967295", name));
    return static_cast<std::uint32_t>(number);
}

/// rig(name, {seed =, specimen =}): the course's experiments, with the parameters their headers state or another
/// specimen's.
int rig(Call& call) {
    call.at_most(2);
    const Options options(call, 2, {"seed", "specimen"});
    const std::uint32_t seed = small_number(options, "seed", 1), specimen = small_number(options, "specimen", 0);
    const Rig& rig = rig_of(call);
    rig.record(call, seed, specimen);
    refuse_unknown_fields(call.state(), std::string(rig.name));
    return 1;
}

int rig_truth(Call& call) {
    call.at_most(2);
    const Options options(call, 2, {"specimen"});
    const Rig& rig = rig_of(call);
    rig.theory(call, small_number(options, "specimen", 0));
    refuse_unknown_fields(call.state(), fmt::format("the truth of {}", rig.name));
    return 1;
}

constexpr std::array kRigsFunctions = {
    FunctionEntry{"rig", "data", "rig(name, {seed =, specimen =}) -> table",
                  "repeats one of the course's simulated experiments, with other noise for another seed",
                  guarded<memoized_call<rig>>},
    FunctionEntry{"rig_truth", "data", "rig_truth(name, {specimen =}) -> table",
                  "what theory says of one of the course's simulated experiments", guarded<rig_truth>},
};

}  // namespace

FunctionEntries rig_functions() {
    return kRigsFunctions;
}

}  // namespace dynlab::inline scripting
