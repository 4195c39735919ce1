#include "numerics/plants/drifting_process.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/plants/plant_data.h"
#include "numerics/simulation/ode_solver.h"

namespace dynlab::inline numerics {
namespace {

/// When the scale that lies on the heater at t began to grow.
double growing_since(const DriftingProcessParameters& p, double t) {
    return t < p.cleaning_time ? 0 : p.cleaning_time;
}
double scale(const DriftingProcessParameters& p, double age) {
    return 1 - std::exp(-age / p.growth_time);
}
double gain_with(const DriftingProcessParameters& p, double scale) {
    return p.clean_gain * (1 - p.lost_gain * scale);
}
double time_constant_with(const DriftingProcessParameters& p, double scale) {
    return p.clean_time_constant * (1 + p.more_time * scale);
}

}  // namespace

void DriftingProcessParameters::validate() const {
    const char* plant = "drifting process";
    require_not_negative(plant, "lost gain", lost_gain, "further time", more_time, "noise standard deviation",
                         noise_std, "resolution", resolution);
    require_positive(plant, "clean gain", clean_gain, "clean time constant", clean_time_constant, "growth time",
                     growth_time, "cleaning time", cleaning_time, "remaining gain", 1 - lost_gain);
}

double DriftingProcessParameters::gain(double t) const {
    return gain_with(*this, scale(*this, t - growing_since(*this, t)));
}

double DriftingProcessParameters::time_constant(double t) const {
    return time_constant_with(*this, scale(*this, t - growing_since(*this, t)));
}

void DriftingProcessExperiments::validate() const {
    const char* plant = "drifting process";
    require_not_negative(plant, "lowest power", low);
    require_positive(plant, "sampling time", Ts, "difference of the powers", high - low);
}

Vector simulate_drifting_process(const DriftingProcessParameters& p, const Vector& u, double Ts, RandomStream& random) {
    p.validate();
    require_positive("drifting process", "sampling time", Ts);
    if (u.size() == 0 || !u.allFinite())
        throw InvalidArgument(
            "The power of the drifting process must have at least one sample, and every sample must be finite");
    double power = u[0], since = 0;
    OdeSolver solver(
        [&](double t, const OdeState& x) {
            const double s = scale(p, t - since);
            return OdeState{{(gain_with(p, s) * power - x[0]) / time_constant_with(p, s)}};
        },
        {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-10, .first_step = 0.01});
    OdeState x{{p.gain(0) * power}};
    Vector rise(u.size());
    double t = 0;
    for (Index k = 0; k < u.size(); ++k) {
        rise[k] = x[0];
        power = u[k];
        const double end = static_cast<double>(k + 1) * Ts;
        if (since == 0 && p.cleaning_time < end) {  // no step may run across it: the coefficients jump
            solver.advance(t, x, p.cleaning_time);
            since = p.cleaning_time;
        }
        solver.advance(t, x, end);
    }
    return measure(rise, p.noise_std, p.resolution, random);
}

PlantData simulate_drifting_process(const DriftingProcessParameters& parameters, const DriftingProcessExperiments& plan,
                                    std::uint32_t seed) {
    plan.validate();
    RandomStream random(seed);
    PlantData data_set;
    data_set.u = seeded_prbs(plan.prbs_stages, plan.prbs_hold, plan.low, plan.high, random);
    data_set.t = Vector::LinSpaced(data_set.u.size(), 0, static_cast<double>(data_set.u.size() - 1)) * plan.Ts;
    data_set.y = simulate_drifting_process(parameters, data_set.u, plan.Ts, random);
    return data_set;
}

}  // namespace dynlab::inline numerics
