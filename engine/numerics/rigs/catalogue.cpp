#include "numerics/rigs/catalogue.h"

#include <algorithm>

#include "numerics/rigs/crane_experiments.h"
#include "numerics/rigs/specimen.h"

namespace dynlab::inline numerics {
namespace {

RigValues input_and_output(const RigRecord& record) {
    return {{"t", record.t}, {"u", record.u}, {"y", record.y}};
}

/// Adds a further record whose names end in `part`.
void add_part(RigValues& values, const RigRecord& record, const std::string& part) {
    for (RigValue& value : input_and_output(record)) values.push_back({value.name + part, std::move(value.value)});
}

RigValues crane_record(const RigChoice& choice) {
    RigValues values;
    for (CraneRecord& experiment : simulate_crane(crane_specimen(choice.specimen), {}, choice.seed))
        values.push_back({experiment.name, RigValues{{"t", std::move(experiment.t)},
                                                     {"u", std::move(experiment.u)},
                                                     {"x", std::move(experiment.x)},
                                                     {"theta", std::move(experiment.theta)}}});
    return values;
}

RigValues crane_theory(std::uint32_t specimen) {
    const CraneTruth truth = crane_truth(crane_specimen(specimen));
    return {{"natural_frequency", truth.natural_frequency},
            {"damping_ratio", truth.damping_ratio},
            {"speed_gain", truth.speed_gain},
            {"dry_voltage", truth.dry_voltage},
            {"starting_voltage", truth.starting_voltage},
            {"time_constant", truth.time_constant}};
}

RigValues drifting_process_record(const RigChoice& choice) {
    return input_and_output(simulate_drifting_process(drifting_process_specimen(choice.specimen), {}, choice.seed));
}

RigValues drifting_process_theory(std::uint32_t specimen) {
    const DriftingProcessParameters rig = drifting_process_specimen(specimen);
    const RigRecord record = simulate_drifting_process(rig, {}, 1);
    const Vector& t = record.t;
    return {{"noise_std", rig.noise_std},
            {"cleaning_time", rig.cleaning_time},
            {"t", t},
            {"gain", Vector(t.unaryExpr([&rig](double time) { return rig.gain(time); }))},
            {"time_constant", Vector(t.unaryExpr([&rig](double time) { return rig.time_constant(time); }))}};
}

RigValues drive_record(const RigChoice& choice) {
    RigValues values;
    for (DriveRecord& experiment : simulate_drive(drive_specimen(choice.specimen), {}, choice.seed))
        values.push_back({experiment.name, RigValues{{"t", std::move(experiment.t)},
                                                     {"r", std::move(experiment.r)},
                                                     {"u", std::move(experiment.u)},
                                                     {"y", std::move(experiment.y)}}});
    return values;
}

RigValues drive_theory(std::uint32_t specimen) {
    const DriveParameters rig = drive_specimen(specimen);
    return {{"G", drive_plant(rig)},    {"load", drive_load(rig)},    {"controller", drive_controller(rig)},
            {"load_std", rig.load_std}, {"load_time", rig.load_time}, {"noise_std", rig.noise_std}};
}

RigValues heat_exchanger_record(const RigChoice& choice) {
    return input_and_output(simulate_heat_exchanger(heat_exchanger_specimen(choice.specimen), choice.seed));
}

RigValues heat_exchanger_theory(std::uint32_t specimen) {
    const HeatExchangerTruth truth = heat_exchanger_truth(heat_exchanger_specimen(specimen));
    return {{"gain", truth.gain},
            {"time_constant", truth.time_constant},
            {"output_at_zero_input", truth.output_at_zero_input},
            {"initial_output", truth.initial_output},
            {"final_output", truth.final_output}};
}

RigValues heat_transfer_record(const RigChoice& choice) {
    const HeatTransferRecords records =
        simulate_heat_transfer(heat_transfer_specimen(choice.specimen), {}, choice.seed);
    RigValues values = input_and_output(records.estimation);
    add_part(values, records.validation, "_val");
    add_part(values, records.high, "_high");
    return values;
}

RigValues heat_transfer_theory(std::uint32_t specimen) {
    const HeatTransferParameters rig = heat_transfer_specimen(specimen);
    const HeatTransferExperiments plan;
    const auto about = [&rig](double voltage) {
        const HeatTransferTruth truth = heat_transfer_truth(rig, voltage);
        return RigValues{{"voltage", voltage},
                         {"temperature", truth.temperature},
                         {"gain", truth.gain},
                         {"slow", truth.slow},
                         {"fast", truth.fast}};
    };
    return {{"dead_time", rig.dead_time},
            {"sensor_time", rig.sensor_time},
            {"low", about(plan.low)},
            {"high", about(plan.high)}};
}

RigValues linear_system_record(const RigChoice& choice) {
    const LinearSystemRecords records = simulate_linear_system(linear_system_specimen(choice.specimen), choice.seed);
    RigValues values = input_and_output(records.estimation);
    add_part(values, records.validation, "_val");
    return values;
}

RigValues linear_system_theory(std::uint32_t specimen) {
    const LinearSystemParameters rig = linear_system_specimen(specimen);
    return {{"noise_std", rig.noise_std}, {"G", linear_system_truth(rig)}};
}

RigValues step_response_record(const RigChoice& choice) {
    const FirstOrderStepRecord record = simulate_first_order_step(step_response_specimen(choice.specimen), choice.seed);
    return {{"t", record.t},
            {"u", record.u},
            {"y", record.y},
            {"ydot", record.ydot},
            {"y_noisy", record.y_noisy},
            {"ydot_noisy", record.ydot_noisy}};
}

RigValues step_response_theory(std::uint32_t specimen) {
    const FirstOrderStepTruth truth = first_order_step_truth(step_response_specimen(specimen));
    return {{"a", truth.a}, {"b", truth.b}, {"f", truth.f}, {"g", truth.g}};
}

RigValues suspension_record(const RigChoice& choice) {
    return input_and_output(simulate_suspension(suspension_specimen(choice.specimen), choice.seed));
}

RigValues suspension_theory(std::uint32_t specimen) {
    const SuspensionTruth truth = suspension_truth(suspension_specimen(specimen));
    return {{"gain", truth.gain},
            {"natural_frequency", truth.natural_frequency},
            {"damping_ratio", truth.damping_ratio},
            {"overshoot", truth.overshoot},
            {"overshoot_time", truth.overshoot_time}};
}

RigValues thruster_record(const RigChoice& choice) {
    RigValues values;
    for (ThrusterRecord& experiment : simulate_thruster(thruster_specimen(choice.specimen), {}, choice.seed))
        values.push_back({experiment.name, RigValues{{"t", std::move(experiment.t)},
                                                     {"pwm", std::move(experiment.pwm)},
                                                     {"force", std::move(experiment.force)}}});
    return values;
}

RigValues thruster_theory(std::uint32_t specimen) {
    const ThrusterParameters rig = thruster_specimen(specimen);
    const ThrusterTruth truth = thruster_truth(rig);
    const Vector pwm = Vector::LinSpaced(81, rig.neutral - rig.full_width, rig.neutral + rig.full_width);
    const Vector thrust = pwm.unaryExpr([&rig](double width) { return thruster_thrust(rig, width); });
    return {{"delay", truth.delay},
            {"neutral", rig.neutral},
            {"dead_band", rig.dead_band},
            {"forward_thrust", truth.forward_thrust},
            {"reverse_thrust", truth.reverse_thrust},
            {"slow_time_constant", truth.slow_time_constant},
            {"fast_time_constant", truth.fast_time_constant},
            {"cell_frequency", rig.cell_frequency},
            {"cell_damping", rig.cell_damping},
            {"pwm", pwm},
            {"thrust", thrust}};
}

RigValues two_tanks_record(const RigChoice& choice) {
    const TwoTanksRecords records = simulate_two_tanks(two_tanks_specimen(choice.specimen), {}, choice.seed);
    RigValues values = input_and_output(records.estimation);
    add_part(values, records.validation, "_val");
    return values;
}

RigValues two_tanks_theory(std::uint32_t specimen) {
    const TwoTanksParameters rig = two_tanks_specimen(specimen);
    const double voltage = TwoTanksExperiments().mean_voltage;
    const TwoTanksTruth truth = two_tanks_truth(rig, voltage);
    return {{"k1", rig.k1},
            {"k2", rig.k2},
            {"k3", rig.k3},
            {"k4", rig.k4},
            {"overflow_part", rig.overflow_part},
            {"sensor_offset", rig.sensor_offset},
            {"sensor_gain", rig.sensor_gain},
            {"height", rig.height},
            {"noise_std", rig.noise_std},
            {"mean", RigValues{{"voltage", voltage},
                               {"upper_level", truth.upper_level},
                               {"lower_level", truth.lower_level},
                               {"output", truth.output},
                               {"gain", truth.gain},
                               {"upper", truth.upper},
                               {"lower", truth.lower}}}};
}

std::vector<Rig> all_rigs() {
    return {
        {"crane",
         "Trolley crane",
         {{"t", "s"}, {"u", "V"}, {"x", "m"}, {"theta", "rad"}},
         {"estimation", "validation", "steps", "free_swing", "limits"},
         CraneExperiments().Ts,
         crane_record,
         crane_theory},
        {"drifting_process",
         "A water heater that furs up",
         {{"t", "s"}, {"u", "%"}, {"y", "K"}},
         {},
         DriftingProcessExperiments().Ts,
         drifting_process_record,
         drifting_process_theory},
        {"drive",
         "Drive with speed control",
         {{"t", "s"}, {"r", "rad/s"}, {"u", "V"}, {"y", "rad/s"}},
         {"tracking", "validation", "regulation", "open_loop"},
         DriveParameters().Ts,
         drive_record,
         drive_theory},
        {"heat_exchanger",
         "Step response of a heat exchanger",
         {{"t", "s"}, {"u", "%"}, {"y", "°C"}},
         {},
         HeatExchangerParameters().Ts,
         heat_exchanger_record,
         heat_exchanger_theory},
        {"heat_transfer",
         "Heat-transfer rig, records for estimation, validation and another operating point",
         {{"t", "s"},
          {"u", "V"},
          {"y", "°C"},
          {"t_val", "s"},
          {"u_val", "V"},
          {"y_val", "°C"},
          {"t_high", "s"},
          {"u_high", "V"},
          {"y_high", "°C"}},
         {},
         HeatTransferExperiments().Ts,
         heat_transfer_record,
         heat_transfer_theory},
        {"linear_system",
         "A linear system, records for estimation and validation",
         {{"t", "s"}, {"u", ""}, {"y", ""}, {"t_val", "s"}, {"u_val", ""}, {"y_val", ""}},
         {},
         LinearSystemParameters().Ts,
         linear_system_record,
         linear_system_theory},
        {"step_response",
         "Step response of a first-order system",
         {{"t", "s"}, {"u", ""}, {"y", ""}, {"ydot", "1/s"}, {"y_noisy", ""}, {"ydot_noisy", "1/s"}},
         {},
         FirstOrderStepParameters().Ts,
         step_response_record,
         step_response_theory},
        {"suspension",
         "Response of a suspension to a unit step",
         {{"t", "s"}, {"u", "V"}, {"y", "mm"}},
         {},
         SuspensionParameters().Ts,
         suspension_record,
         suspension_theory},
        {"thruster",
         "Thruster",
         {{"t", "s"}, {"pwm", "µs"}, {"force", "N"}},
         {"sine_100", "sine_200", "sine_300", "square_100", "square_200", "square_300"},
         ThrusterExperiments().Ts,
         thruster_record,
         thruster_theory},
        {"two_tanks",
         "Two tanks, records for estimation and validation",
         {{"t", "s"}, {"u", "V"}, {"y", "V"}, {"t_val", "s"}, {"u_val", "V"}, {"y_val", "V"}},
         {},
         TwoTanksExperiments().Ts,
         two_tanks_record,
         two_tanks_theory},
    };
}

}  // namespace

std::span<const Rig> rig_catalogue() {
    static const std::vector<Rig> rigs = all_rigs();
    return rigs;
}

const Rig* find_rig(std::string_view name) {
    const std::span<const Rig> rigs = rig_catalogue();
    const auto found = std::find_if(rigs.begin(), rigs.end(), [name](const Rig& rig) { return rig.name == name; });
    return found == rigs.end() ? nullptr : &*found;
}

}  // namespace dynlab::inline numerics
