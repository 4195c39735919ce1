#pragma once
#include <cstdint>

#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {

/// A suspension on its test bench: a mass on a spring and a damper, pushed by an electric actuator:
///     mass d2x/dt2 + damping dx/dt + stiffness x = force_per_volt u.
/// u is the actuator's voltage, a step of `step_height` at `step_time` (rounded to a sample; with 0 the data begin at
/// the step); y is the displacement in millimetres from rest, read by a displacement sensor.
struct SuspensionParameters {
    double mass = 12;            ///< kg
    double stiffness = 2000;     ///< N/m
    double damping = 60;         ///< N s/m
    double force_per_volt = 20;  ///< N/V
    double step_height = 1;      ///< V
    double step_time = 0;        ///< s
    double duration = 4;         ///< s
    double Ts = 0.01;            ///< s
    double noise_std = 0.05;     ///< of the sensor, mm
    double resolution = 0.01;    ///< of the sensor, mm; 0 for none

    /// Throws InvalidArgument naming the first value that is not physical, and for a damping so strong that the
    /// response does not swing.
    void validate() const;
};

/// Y(s) = gain w0^2/(s^2 + 2 z w0 s + w0^2) U(s).
struct SuspensionTruth {
    double gain;               ///< mm per V
    double natural_frequency;  ///< w0, rad/s
    double damping_ratio;      ///< z
    double overshoot;          ///< D1 = exp(-pi z/sqrt(1 - z^2)), part of the final value
    double overshoot_time;     ///< after the step, pi/(w0 sqrt(1 - z^2)), s
};

/// True values of the quantities that the data show, computed from the parameters. Throws InvalidArgument as their
/// validate().
SuspensionTruth suspension_truth(const SuspensionParameters& parameters);

/// The sampled experiment; equal seeds give equal data.
PlantData simulate_suspension(const SuspensionParameters& parameters, std::uint32_t seed);

}  // namespace dynlab::inline numerics
