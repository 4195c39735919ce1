#include "numerics/plants/crane_control.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {
namespace {

double reading(double truth, double noise_std, double resolution, RandomStream& random) {
    return measure(Vector::Constant(1, truth), noise_std, resolution, random)[0];
}

}  // namespace

void CraneRun::validate(const CraneParameters& parameters) const {
    if (!(duration > 0) || !std::isfinite(duration))
        throw InvalidArgument("The duration of a crane run must be positive, but is {}", significant(duration, 6));
    if (!std::isfinite(angle)) throw InvalidArgument("The initial angle of the crane must be finite");
    if (!(std::abs(position) <= parameters.rail))
        throw InvalidArgument("The initial position of the crane must be on the rail, between -{} m and {} m",
                              parameters.rail, parameters.rail);
}

CraneData control_crane(const CraneParameters& parameters, const CraneExperiments& plan, const CraneRun& run,
                        const CraneController& controller, std::uint32_t seed) {
    plan.validate();
    run.validate(parameters);
    CraneState start;
    start.motor_position = start.position = run.position;
    start.angle = run.angle;
    CraneSimulator crane(parameters, start);
    RandomStream random(seed);
    const Vector t = sampling_instants(run.duration, plan.Ts);
    CraneData data_set{"control", t, Vector(t.size()), Vector(t.size()), Vector(t.size())};
    for (Index k = 0; k < t.size(); ++k) {
        const CraneState state = crane.state();
        data_set.x[k] = reading(state.position, 0, plan.position_resolution, random);
        data_set.theta[k] = reading(state.angle, plan.angle_noise_std, plan.angle_resolution, random);
        data_set.u[k] = controller(t[k], data_set.x[k], data_set.theta[k]);
        if (!std::isfinite(data_set.u[k]))
            throw InvalidArgument("the controller returned a voltage that is not finite at t = {} s", t[k]);
        crane.advance(data_set.u[k], plan.Ts);
    }
    return data_set;
}

}  // namespace dynlab::inline numerics
