#pragma once
#include <cstdint>

#include "numerics/plants/plant_data.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

/// Air blown over an electric heater and through a tube, its temperature measured at the end:
///     heater_capacity dT_h/dt = power (u/full_voltage)^2 - transfer (T_h - T_a)
///     air_capacity    dT_a/dt = transfer (T_h - T_a) - flow (T_a - T_in)
///     sensor_time     dT_s/dt = T_a(t - dead_time) - T_s
/// u is the heater's voltage, so the gain grows with the operating point; y is T_s in degrees Celsius, noisy and
/// rounded. The inlet's temperature drifts: T_in = inlet + drift sin(2 pi (t + dead_time)/drift_period + phase), the
/// phase drawn from the seed. Every experiment begins at the equilibrium of its operating point.
struct HeatTransferParameters {
    double heater_capacity = 60;  ///< J/K
    double air_capacity = 10;     ///< of air and tube, J/K
    double transfer = 3;          ///< from heater to air, W/K
    double flow = 1.5;            ///< heat capacity of the air blown through, W/K
    double power = 100;           ///< at full voltage, W
    double full_voltage = 10;     ///< V
    double sensor_time = 3;       ///< s
    double dead_time = 4.5;       ///< from the heater to the sensor, s
    double inlet = 20;            ///< degrees Celsius
    double drift = 0.4;           ///< K
    double drift_period = 1300;   ///< s
    double noise_std = 0.15;      ///< of the sensor, K
    double resolution = 0.1;      ///< of the sensor, K; 0 for none

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// A pseudo-random binary voltage about an operating point, after a rest there.
struct HeatTransferExperiments {
    double low = 4;        ///< operating point of the estimation and validation data, V
    double high = 7;       ///< the other operating point, V
    double amplitude = 1;  ///< V
    int prbs_stages = 6;   ///< 63 bits
    int prbs_hold = 15;    ///< samples per bit
    double rest = 60;      ///< s
    double Ts = 1;         ///< s; the voltage is held between samples

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// Small changes about an operating point U (V): T = temperature + gain e^(-dead_time s)/
/// ((sensor_time s + 1)(slow s + 1)(fast s + 1)) (u - U).
struct HeatTransferTruth {
    double temperature;  ///< equilibrium without drift, degrees Celsius
    double gain;         ///< K/V
    double slow, fast;   ///< time constants of heater and air, s
};
/// Throws InvalidArgument as the parameters' validate() does.
HeatTransferTruth heat_transfer_truth(const HeatTransferParameters& parameters, double operating_point);

/// The measured temperature for a sequence of voltages that begins at the equilibrium of its first value; draws the
/// drift's phase, then the noise.
Vector simulate_heat_transfer(const HeatTransferParameters& parameters, const Vector& u, double Ts,
                              RandomStream& random);

struct HeatTransferData {
    PlantData estimation, validation;  ///< about the low operating point, two orders of bits
    PlantData high;                    ///< about the high one
};
/// Equal seeds give equal data.
HeatTransferData simulate_heat_transfer(const HeatTransferParameters& parameters,
                                        const HeatTransferExperiments& experiments, std::uint32_t seed);

}  // namespace dynlab::inline numerics
