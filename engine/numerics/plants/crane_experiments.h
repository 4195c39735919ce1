#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "numerics/plants/crane.h"

namespace dynlab::inline numerics {

/// How the crane is driven and measured. Each experiment but the free swing begins with `quiet_time` at 0 V, the load
/// hanging at rest.
struct CraneExperiments {
    double Ts = 0.02;                   ///< s; the voltage is held between samples
    double quiet_time = 1;              ///< s
    double prbs_amplitude = 2;          ///< V
    int prbs_stages = 7;                ///< 127 bits
    int prbs_hold = 12;                 ///< samples per bit
    double release_angle = 0.3;         ///< of the free swing, rad
    double position_resolution = 2e-4;  ///< of the encoder, m; 0 for none
    double angle_noise_std = 2e-3;      ///< of the potentiometer, rad
    double angle_resolution = 1.5e-3;   ///< of its converter, rad; 0 for none
    double angle_offset = 0.012;        ///< reading of the hanging pendulum, rad

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// Instants (s), commanded voltage (V), measured position (m) and angle (rad), N values each.
struct CraneData {
    std::string name;
    Vector t, u, x, theta;
};

/// The experiments, in this order:
///   estimation, validation  a seeded PRBS each, the trolley placed so that the way it will go is centered on the rail;
///   steps                   pushes of 2 V and 4 V to either side with rests between them;
///   free_swing              motor at 0 V, pendulum let go at release_angle;
///   limits                  PRBS, then +-12 V by hand: beyond the amplifier's limit and into both buffers, then PRBS.
/// Equal seeds give equal data.
std::vector<CraneData> simulate_crane(const CraneParameters& parameters, const CraneExperiments& experiments,
                                      std::uint32_t seed);

}  // namespace dynlab::inline numerics
