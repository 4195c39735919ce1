#include "numerics/plants/plant_catalog.h"

#include <algorithm>

#include "numerics/plants/crane_experiments.h"
#include "numerics/plants/plant_variant.h"

namespace dynlab::inline numerics {
namespace {

PlantValues input_and_output(const PlantData& simulated_data) {
    return {{"t", simulated_data.t}, {"u", simulated_data.u}, {"y", simulated_data.y}};
}

/// Adds another experiment whose names end in `part`.
void add_part(PlantValues& values, const PlantData& simulated_data, const std::string& part) {
    for (PlantValue& value : input_and_output(simulated_data))
        values.push_back({value.name + part, std::move(value.value)});
}

PlantValues crane_data(const PlantChoice& choice) {
    PlantValues values;
    for (CraneData& experiment : simulate_crane(crane_variant(choice.variant_number), {}, choice.seed))
        values.push_back({experiment.name, PlantValues{{"t", std::move(experiment.t)},
                                                       {"u", std::move(experiment.u)},
                                                       {"x", std::move(experiment.x)},
                                                       {"theta", std::move(experiment.theta)}}});
    return values;
}

PlantValues crane_theory(std::uint32_t variant_number) {
    const CraneTruth truth = crane_truth(crane_variant(variant_number));
    return {{"natural_frequency", truth.natural_frequency},
            {"damping_ratio", truth.damping_ratio},
            {"speed_gain", truth.speed_gain},
            {"dry_voltage", truth.dry_voltage},
            {"starting_voltage", truth.starting_voltage},
            {"time_constant", truth.time_constant}};
}

PlantValues drifting_process_data(const PlantChoice& choice) {
    return input_and_output(
        simulate_drifting_process(drifting_process_variant(choice.variant_number), {}, choice.seed));
}

PlantValues drifting_process_theory(std::uint32_t variant_number) {
    const DriftingProcessParameters plant = drifting_process_variant(variant_number);
    const PlantData simulated_data = simulate_drifting_process(plant, {}, 1);
    const Vector& t = simulated_data.t;
    return {{"noise_std", plant.noise_std},
            {"cleaning_time", plant.cleaning_time},
            {"t", t},
            {"gain", Vector(t.unaryExpr([&plant](double time) { return plant.gain(time); }))},
            {"time_constant", Vector(t.unaryExpr([&plant](double time) { return plant.time_constant(time); }))}};
}

PlantValues drive_data(const PlantChoice& choice) {
    PlantValues values;
    for (DriveData& experiment : simulate_drive(drive_variant(choice.variant_number), {}, choice.seed))
        values.push_back({experiment.name, PlantValues{{"t", std::move(experiment.t)},
                                                       {"r", std::move(experiment.r)},
                                                       {"u", std::move(experiment.u)},
                                                       {"y", std::move(experiment.y)}}});
    return values;
}

PlantValues drive_theory(std::uint32_t variant_number) {
    const DriveParameters plant = drive_variant(variant_number);
    return {{"G", drive_plant(plant)},    {"load", drive_load(plant)},    {"controller", drive_controller(plant)},
            {"load_std", plant.load_std}, {"load_time", plant.load_time}, {"noise_std", plant.noise_std}};
}

PlantValues heat_exchanger_data(const PlantChoice& choice) {
    return input_and_output(simulate_heat_exchanger(heat_exchanger_variant(choice.variant_number), choice.seed));
}

PlantValues heat_exchanger_theory(std::uint32_t variant_number) {
    const HeatExchangerTruth truth = heat_exchanger_truth(heat_exchanger_variant(variant_number));
    return {{"gain", truth.gain},
            {"time_constant", truth.time_constant},
            {"output_at_zero_input", truth.output_at_zero_input},
            {"initial_output", truth.initial_output},
            {"final_output", truth.final_output}};
}

PlantValues heat_transfer_data(const PlantChoice& choice) {
    const HeatTransferData data_sets =
        simulate_heat_transfer(heat_transfer_variant(choice.variant_number), {}, choice.seed);
    PlantValues values = input_and_output(data_sets.estimation);
    add_part(values, data_sets.validation, "_val");
    add_part(values, data_sets.high, "_high");
    return values;
}

PlantValues heat_transfer_theory(std::uint32_t variant_number) {
    const HeatTransferParameters plant = heat_transfer_variant(variant_number);
    const HeatTransferExperiments plan;
    const auto about = [&plant](double voltage) {
        const HeatTransferTruth truth = heat_transfer_truth(plant, voltage);
        return PlantValues{{"voltage", voltage},
                           {"temperature", truth.temperature},
                           {"gain", truth.gain},
                           {"slow", truth.slow},
                           {"fast", truth.fast}};
    };
    return {{"dead_time", plant.dead_time},
            {"sensor_time", plant.sensor_time},
            {"low", about(plan.low)},
            {"high", about(plan.high)}};
}

PlantValues linear_system_data(const PlantChoice& choice) {
    const LinearSystemData data_sets =
        simulate_linear_system(linear_system_variant(choice.variant_number), choice.seed);
    PlantValues values = input_and_output(data_sets.estimation);
    add_part(values, data_sets.validation, "_val");
    return values;
}

PlantValues linear_system_theory(std::uint32_t variant_number) {
    const LinearSystemParameters plant = linear_system_variant(variant_number);
    return {{"noise_std", plant.noise_std}, {"G", linear_system_truth(plant)}};
}

PlantValues step_response_data(const PlantChoice& choice) {
    const FirstOrderStepData simulated_data =
        simulate_first_order_step(step_response_variant(choice.variant_number), choice.seed);
    return {{"t", simulated_data.t},
            {"u", simulated_data.u},
            {"y", simulated_data.y},
            {"ydot", simulated_data.ydot},
            {"y_noisy", simulated_data.y_noisy},
            {"ydot_noisy", simulated_data.ydot_noisy}};
}

PlantValues step_response_theory(std::uint32_t variant_number) {
    const FirstOrderStepTruth truth = first_order_step_truth(step_response_variant(variant_number));
    return {{"a", truth.a}, {"b", truth.b}, {"f", truth.f}, {"g", truth.g}};
}

PlantValues suspension_data(const PlantChoice& choice) {
    return input_and_output(simulate_suspension(suspension_variant(choice.variant_number), choice.seed));
}

PlantValues suspension_theory(std::uint32_t variant_number) {
    const SuspensionTruth truth = suspension_truth(suspension_variant(variant_number));
    return {{"gain", truth.gain},
            {"natural_frequency", truth.natural_frequency},
            {"damping_ratio", truth.damping_ratio},
            {"overshoot", truth.overshoot},
            {"overshoot_time", truth.overshoot_time}};
}

PlantValues thruster_data(const PlantChoice& choice) {
    PlantValues values;
    for (ThrusterData& experiment : simulate_thruster(thruster_variant(choice.variant_number), {}, choice.seed))
        values.push_back({experiment.name, PlantValues{{"t", std::move(experiment.t)},
                                                       {"pwm", std::move(experiment.pwm)},
                                                       {"force", std::move(experiment.force)}}});
    return values;
}

PlantValues thruster_theory(std::uint32_t variant_number) {
    const ThrusterParameters plant = thruster_variant(variant_number);
    const ThrusterTruth truth = thruster_truth(plant);
    const Vector pwm = Vector::LinSpaced(81, plant.neutral - plant.full_width, plant.neutral + plant.full_width);
    const Vector thrust = pwm.unaryExpr([&plant](double width) { return thruster_thrust(plant, width); });
    return {{"delay", truth.delay},
            {"neutral", plant.neutral},
            {"dead_band", plant.dead_band},
            {"forward_thrust", truth.forward_thrust},
            {"reverse_thrust", truth.reverse_thrust},
            {"slow_time_constant", truth.slow_time_constant},
            {"fast_time_constant", truth.fast_time_constant},
            {"cell_frequency", plant.cell_frequency},
            {"cell_damping", plant.cell_damping},
            {"pwm", pwm},
            {"thrust", thrust}};
}

PlantValues two_tanks_data(const PlantChoice& choice) {
    const TwoTanksData data_sets = simulate_two_tanks(two_tanks_variant(choice.variant_number), {}, choice.seed);
    PlantValues values = input_and_output(data_sets.estimation);
    add_part(values, data_sets.validation, "_val");
    return values;
}

PlantValues two_tanks_theory(std::uint32_t variant_number) {
    const TwoTanksParameters plant = two_tanks_variant(variant_number);
    const double voltage = TwoTanksExperiments().mean_voltage;
    const TwoTanksTruth truth = two_tanks_truth(plant, voltage);
    return {{"k1", plant.k1},
            {"k2", plant.k2},
            {"k3", plant.k3},
            {"k4", plant.k4},
            {"overflow_part", plant.overflow_part},
            {"sensor_offset", plant.sensor_offset},
            {"sensor_gain", plant.sensor_gain},
            {"height", plant.height},
            {"noise_std", plant.noise_std},
            {"mean", PlantValues{{"voltage", voltage},
                                 {"upper_level", truth.upper_level},
                                 {"lower_level", truth.lower_level},
                                 {"output", truth.output},
                                 {"gain", truth.gain},
                                 {"upper", truth.upper},
                                 {"lower", truth.lower}}}};
}

std::vector<Plant> all_plants() {
    return {
        {"crane",
         "Trolley crane",
         {{"t", "s"}, {"u", "V"}, {"x", "m"}, {"theta", "rad"}},
         {"estimation", "validation", "steps", "free_swing", "limits"},
         CraneExperiments().Ts,
         crane_data,
         crane_theory},
        {"drifting_process",
         "A water heater that furs up",
         {{"t", "s"}, {"u", "%"}, {"y", "K"}},
         {},
         DriftingProcessExperiments().Ts,
         drifting_process_data,
         drifting_process_theory},
        {"drive",
         "Drive with speed control",
         {{"t", "s"}, {"r", "rad/s"}, {"u", "V"}, {"y", "rad/s"}},
         {"tracking", "validation", "regulation", "open_loop"},
         DriveParameters().Ts,
         drive_data,
         drive_theory},
        {"heat_exchanger",
         "Step response of a heat exchanger",
         {{"t", "s"}, {"u", "%"}, {"y", "°C"}},
         {},
         HeatExchangerParameters().Ts,
         heat_exchanger_data,
         heat_exchanger_theory},
        {"heat_transfer",
         "Heat-transfer plant, data for estimation, validation and another operating point",
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
         heat_transfer_data,
         heat_transfer_theory},
        {"linear_system",
         "A linear system, data for estimation and validation",
         {{"t", "s"}, {"u", ""}, {"y", ""}, {"t_val", "s"}, {"u_val", ""}, {"y_val", ""}},
         {},
         LinearSystemParameters().Ts,
         linear_system_data,
         linear_system_theory},
        {"step_response",
         "Step response of a first-order system",
         {{"t", "s"}, {"u", ""}, {"y", ""}, {"ydot", "1/s"}, {"y_noisy", ""}, {"ydot_noisy", "1/s"}},
         {},
         FirstOrderStepParameters().Ts,
         step_response_data,
         step_response_theory},
        {"suspension",
         "Response of a suspension to a unit step",
         {{"t", "s"}, {"u", "V"}, {"y", "mm"}},
         {},
         SuspensionParameters().Ts,
         suspension_data,
         suspension_theory},
        {"thruster",
         "Thruster",
         {{"t", "s"}, {"pwm", "µs"}, {"force", "N"}},
         {"sine_100", "sine_200", "sine_300", "square_100", "square_200", "square_300"},
         ThrusterExperiments().Ts,
         thruster_data,
         thruster_theory},
        {"two_tanks",
         "Two tanks, data for estimation and validation",
         {{"t", "s"}, {"u", "V"}, {"y", "V"}, {"t_val", "s"}, {"u_val", "V"}, {"y_val", "V"}},
         {},
         TwoTanksExperiments().Ts,
         two_tanks_data,
         two_tanks_theory},
    };
}

}  // namespace

std::span<const Plant> plant_catalog() {
    static const std::vector<Plant> plants = all_plants();
    return plants;
}

const Plant* find_plant(std::string_view name) {
    const std::span<const Plant> plants = plant_catalog();
    const auto found =
        std::find_if(plants.begin(), plants.end(), [name](const Plant& plant) { return plant.name == name; });
    return found == plants.end() ? nullptr : &*found;
}

}  // namespace dynlab::inline numerics
