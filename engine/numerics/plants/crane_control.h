#pragma once
#include <functional>

#include "numerics/plants/crane_experiments.h"

namespace dynlab::inline numerics {

/// Asked at every sample: instant (s), measured position (m) and angle (rad, the reading of the hanging pendulum taken
/// off). Gives the voltage until the next sample.
using CraneController = std::function<double(double t, double x, double theta)>;

/// Where a controlled run begins, at rest, and how long it lasts.
struct CraneRun {
    double duration = 10;  ///< s
    double position = 0;   ///< m
    double angle = 0;      ///< rad

    /// Throws InvalidArgument for a duration that is not positive, numbers that are not finite, a start off the rail.
    void validate(const CraneParameters& parameters) const;
};

/// The nonlinear crane in closed loop, with the sensors and the sampling time of `plan`. The data contain the commanded
/// voltage, and the angle that the controller received. Throws InvalidArgument if the controller returns a voltage that
/// is not finite.
CraneData control_crane(const CraneParameters& parameters, const CraneExperiments& plan, const CraneRun& run,
                        const CraneController& controller, std::uint32_t seed);

}  // namespace dynlab::inline numerics
