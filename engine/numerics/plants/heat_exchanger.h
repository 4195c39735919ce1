#pragma once
#include <cstdint>

#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {

/// A well-mixed water heater: water flows through a vessel of uniform temperature, a heating valve lets power in,
/// the vessel's wall loses heat to the room:
///     C dT/dt = flow c (T_in - T) + loss (T_room - T) + power u/100,   C = mass c + wall_capacity.
/// u is the valve's opening in %, y the outlet temperature in degrees Celsius. The vessel rests at its equilibrium for
/// `valve_before` at the first sample; the valve moves at `step_time` (rounded to a sample).
struct HeatExchangerParameters {
    double mass = 4.0;              ///< water in the vessel, kg
    double specific_heat = 4186;    ///< of water, J/(kg K)
    double wall_capacity = 1500;    ///< of the steel wall, J/K
    double flow = 0.05;             ///< water through the vessel, kg/s
    double loss = 30;               ///< to the room, W/K
    double inlet_temperature = 15;  ///< degrees Celsius
    double room_temperature = 21;   ///< degrees Celsius
    double power = 12000;           ///< at a fully open valve, W
    double valve_before = 30;       ///< %
    double valve_after = 50;        ///< %
    double step_time = 60;          ///< s
    double duration = 600;          ///< s
    double Ts = 2;                  ///< s
    double noise_std = 0.1;         ///< of the thermometer, K
    double resolution = 0.01;       ///< of the thermometer, K; 0 for none

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// T(s) = output_at_zero_input + gain/(1 + time_constant s) U(s).
struct HeatExchangerTruth {
    double gain;                  ///< K per %
    double time_constant;         ///< s
    double output_at_zero_input;  ///< outlet temperature with the valve closed, degrees Celsius
    double initial_output;        ///< equilibrium before the step, degrees Celsius
    double final_output;          ///< equilibrium after the step, degrees Celsius
};

/// True values of the quantities that the data show, computed from the parameters. Throws InvalidArgument as their
/// validate().
HeatExchangerTruth heat_exchanger_truth(const HeatExchangerParameters& parameters);

/// The sampled experiment; equal seeds give equal data.
PlantData simulate_heat_exchanger(const HeatExchangerParameters& parameters, std::uint32_t seed);

}  // namespace dynlab::inline numerics
