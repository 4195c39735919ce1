#pragma once
#include <array>
#include <cstdint>

#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {

/// Two tanks, one above the other: a pump fills the upper one, which empties into the lower one, which empties into the
/// reservoir, each by the law of Torricelli. With h1, h2 the levels (cm) and u the pump's voltage:
///     dh1/dt = -k1 sqrt(h1) + k4 u                         below the rim, else 0, and what is too much runs over,
///     dh2/dt =  k2 sqrt(h1) - k3 sqrt(h2) + overflow_part (k4 u - k1 sqrt(h1))+     the last term while h1 = height,
/// h2 is limited in the same way. Only the lower level is measured: y = sensor_offset + sensor_gain h2 in volts, noisy
/// and rounded. The process is that of the cascaded tanks of Schoukens and Noel (2017), with other numbers.
struct TwoTanksParameters {
    double k1 = 0.1;             ///< sqrt(cm)/s
    double k2 = 0.102;           ///< sqrt(cm)/s; differs from k1 as the tanks' areas do
    double k3 = 0.104;           ///< sqrt(cm)/s
    double k4 = 0.14;            ///< cm/(s V)
    double overflow_part = 0.6;  ///< of the upper tank's overflow, what the lower one catches
    double height = 20;          ///< of both tanks, cm
    double sensor_gain = 0.5;    ///< V/cm
    double sensor_offset = 0.3;  ///< V
    double noise_std = 0.03;     ///< of the sensor, V
    double resolution = 0.01;    ///< of its converter, V; 0 for none

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// A multisine with the lowest `lines` frequencies of the data, equal amplitudes and random phases, limited to the
/// range of the pump. The pump has run at `start_voltage` for a long time before.
struct TwoTanksExperiments {
    int samples = 1024;
    int lines = 59;               ///< the highest is lines/(samples Ts)
    double mean_voltage = 2.6;    ///< V
    double voltage_std = 1.2;     ///< V, before it is limited
    double greatest_voltage = 5;  ///< V
    double start_voltage = 2;     ///< V
    double Ts = 4;                ///< s; the voltage is held between samples

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// Small changes about a voltage at which nothing runs over: y = output + gain/((upper s + 1)(lower s + 1)) (u - U).
struct TwoTanksTruth {
    double upper_level, lower_level;  ///< in equilibrium, cm
    double output;                    ///< V
    double gain;                      ///< V/V
    double upper, lower;              ///< time constants, s
};
/// Throws InvalidArgument as the parameters' validate() does, and where a tank runs over.
TwoTanksTruth two_tanks_truth(const TwoTanksParameters& parameters, double voltage);

/// The levels (cm) at the samples, one row each: upper and lower tank, from levels `start` between 0 and height.
Matrix two_tanks_levels(const TwoTanksParameters& parameters, const Vector& voltage, double Ts,
                        const std::array<double, 2>& start);

struct TwoTanksData {
    PlantData estimation, validation;  ///< two choices of phases
};
/// Equal seeds give equal data.
TwoTanksData simulate_two_tanks(const TwoTanksParameters& parameters, const TwoTanksExperiments& experiments,
                                std::uint32_t seed);

}  // namespace dynlab::inline numerics
