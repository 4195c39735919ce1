#pragma once
#include <cstdint>

#include "numerics/models/transfer_function.h"
#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {

/// The linear system on which the choice of an order is learnt: one real pole, a resonance and a zero,
///     X(s) = gain (s/zero + 1)/((s/pole + 1)(s^2/w0^2 + 2 z s/w0 + 1)) U(s),      y = x + white normal noise.
/// Both data sets start from rest; u is a seeded pseudo-random binary sequence of +-amplitude.
struct LinearSystemParameters {
    double gain = 2;
    double zero = 4;         ///< rad/s
    double pole = 1.25;      ///< rad/s
    double frequency = 3;    ///< w0, rad/s
    double damping = 0.3;    ///< z
    double amplitude = 1;    ///< of the input
    int prbs_stages = 7;     ///< 127 bits
    int prbs_hold = 8;       ///< samples per bit
    double Ts = 0.05;        ///< s
    double noise_std = 0.2;  ///< of the output

    /// Throws InvalidArgument naming the first value out of its range.
    void validate() const;
};

/// The true system, computed from the parameters. Throws InvalidArgument as their validate().
TransferFunction linear_system_truth(const LinearSystemParameters& parameters);

struct LinearSystemData {
    PlantData estimation, validation;
};
/// Equal seeds give equal data.
LinearSystemData simulate_linear_system(const LinearSystemParameters& parameters, std::uint32_t seed);

}  // namespace dynlab::inline numerics
