#pragma once
#include <cstdint>

#include "numerics/plants/plant_data.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

/// Water flows through an electric heater that collects scale and is descaled once during the experiment:
///     time_constant(t) dx/dt = gain(t) u - x,
/// x the rise of temperature (K), u the heating power (%). With the scale s(t), which grows from 0 towards 1 as
/// 1 - exp(-t/growth_time) and begins again at cleaning_time,
///     gain(t) = clean_gain (1 - lost_gain s(t)),   time_constant(t) = clean_time_constant (1 + more_time s(t)).
/// y is x with white noise, rounded.
struct DriftingProcessParameters {
    double clean_gain = 0.4;          ///< K/%
    double lost_gain = 0.45;          ///< part of it
    double clean_time_constant = 20;  ///< s
    double more_time = 0.8;           ///< part of it
    double growth_time = 1500;        ///< s
    double cleaning_time = 3200;      ///< s
    double noise_std = 0.6;           ///< K
    double resolution = 0.1;          ///< K; 0 for none

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
    double gain(double t) const;
    double time_constant(double t) const;
};

/// A pseudo-random binary heating power.
struct DriftingProcessExperiments {
    double low = 30, high = 70;  ///< %
    int prbs_stages = 8;         ///< 255 bits
    int prbs_hold = 20;          ///< samples per bit
    double Ts = 1;               ///< s; the power is held between samples

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// The measured rise for a sequence of powers, from the equilibrium of the first one; draws the noise.
Vector simulate_drifting_process(const DriftingProcessParameters& parameters, const Vector& u, double Ts,
                                 RandomStream& random);

/// Equal seeds give equal data.
PlantData simulate_drifting_process(const DriftingProcessParameters& parameters,
                                    const DriftingProcessExperiments& experiments, std::uint32_t seed);

}  // namespace dynlab::inline numerics
