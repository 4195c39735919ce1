#include "numerics/plants/heat_exchanger.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {

void HeatExchangerParameters::validate() const {
    const char* plant = "heat exchanger";
    require_not_negative(plant, "wall capacity", wall_capacity, "flow", flow, "loss", loss,
                         "valve opening before the step", valve_before, "valve opening after the step", valve_after,
                         "step time", step_time, "noise standard deviation", noise_std, "resolution", resolution);
    require_positive(plant, "mass", mass, "specific heat", specific_heat, "power", power, "sampling time", Ts,
                     "flow and loss together", flow + loss, "time between step and end", duration - step_time);
    if (valve_before > 100 || valve_after > 100)
        throw InvalidArgument("The valve opening of the heat exchanger must be at most 100 %");
}

HeatExchangerTruth heat_exchanger_truth(const HeatExchangerParameters& p) {
    p.validate();
    const double conductance = p.flow * p.specific_heat + p.loss;  // W/K
    const double capacity = p.mass * p.specific_heat + p.wall_capacity;
    HeatExchangerTruth truth;
    truth.gain = p.power / 100 / conductance;
    truth.time_constant = capacity / conductance;
    truth.output_at_zero_input =
        (p.flow * p.specific_heat * p.inlet_temperature + p.loss * p.room_temperature) / conductance;
    truth.initial_output = truth.output_at_zero_input + truth.gain * p.valve_before;
    truth.final_output = truth.output_at_zero_input + truth.gain * p.valve_after;
    return truth;
}

PlantData simulate_heat_exchanger(const HeatExchangerParameters& p, std::uint32_t seed) {
    const HeatExchangerTruth truth = heat_exchanger_truth(p);
    RandomStream random(seed);
    PlantData data_set;
    data_set.t = sampling_instants(p.duration, p.Ts);
    const Index N = data_set.t.size(), step = static_cast<Index>(std::llround(p.step_time / p.Ts));
    data_set.u.resize(N);
    Vector temperature(N);
    for (Index k = 0; k < N; ++k) {
        data_set.u[k] = k < step ? p.valve_before : p.valve_after;
        const double since_step = static_cast<double>(k - step) * p.Ts;
        const double done = k < step ? 0 : -std::expm1(-since_step / truth.time_constant);
        temperature[k] = truth.initial_output + (truth.final_output - truth.initial_output) * done;
    }
    data_set.y = measure(temperature, p.noise_std, p.resolution, random);
    return data_set;
}

}  // namespace dynlab::inline numerics
