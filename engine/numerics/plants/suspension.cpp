#include "numerics/plants/suspension.h"

#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {

void SuspensionParameters::validate() const {
    const char* plant = "suspension";
    require_not_negative(plant, "damping", damping, "step time", step_time, "noise standard deviation", noise_std,
                         "resolution", resolution);
    require_positive(plant, "mass", mass, "stiffness", stiffness, "force per volt", force_per_volt, "sampling time", Ts,
                     "time between step and end", duration - step_time);
    if (!std::isfinite(step_height) || step_height == 0)
        throw InvalidArgument("The step height of the suspension must be finite and nonzero");
    if (damping * damping >= 4 * stiffness * mass)
        throw InvalidArgument(
            "The damping of the suspension must be less than 2*sqrt(stiffness*mass) = {}, but is {}; otherwise, the "
            "suspension does not oscillate",
            significant(2 * std::sqrt(stiffness * mass), 6), significant(damping, 6));
}

SuspensionTruth suspension_truth(const SuspensionParameters& p) {
    p.validate();
    constexpr double kMillimetresPerMetre = 1000;
    SuspensionTruth truth;
    truth.gain = kMillimetresPerMetre * p.force_per_volt / p.stiffness;
    truth.natural_frequency = std::sqrt(p.stiffness / p.mass);
    truth.damping_ratio = p.damping / (2 * std::sqrt(p.stiffness * p.mass));
    const double root = std::sqrt(1 - truth.damping_ratio * truth.damping_ratio);
    truth.overshoot = std::exp(-std::numbers::pi * truth.damping_ratio / root);
    truth.overshoot_time = std::numbers::pi / (truth.natural_frequency * root);
    return truth;
}

PlantData simulate_suspension(const SuspensionParameters& p, std::uint32_t seed) {
    const SuspensionTruth truth = suspension_truth(p);
    const double z = truth.damping_ratio, root = std::sqrt(1 - z * z), w0 = truth.natural_frequency;
    RandomStream random(seed);
    PlantData data_set;
    data_set.t = sampling_instants(p.duration, p.Ts);
    const Index N = data_set.t.size(), step = static_cast<Index>(std::llround(p.step_time / p.Ts));
    data_set.u = Vector::Zero(N);
    Vector displacement = Vector::Zero(N);
    for (Index k = step; k < N; ++k) {
        data_set.u[k] = p.step_height;
        // Step response: 1 - exp(-z w0 t) (cos(wp t) + z/sqrt(1 - z^2) sin(wp t)), wp = w0 sqrt(1 - z^2).
        const double t = static_cast<double>(k - step) * p.Ts, phase = w0 * root * t;
        const double swing = std::exp(-z * w0 * t) * (std::cos(phase) + z / root * std::sin(phase));
        displacement[k] = truth.gain * p.step_height * (1 - swing);
    }
    data_set.y = measure(displacement, p.noise_std, p.resolution, random);
    return data_set;
}

}  // namespace dynlab::inline numerics
