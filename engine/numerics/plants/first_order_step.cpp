#include "numerics/plants/first_order_step.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {

void FirstOrderStepParameters::validate() const {
    const char* plant = "first-order step";
    require_positive(plant, "time constant", time_constant, "sampling time", Ts);
    require_not_negative(plant, "output noise", output_noise_std, "derivative noise", derivative_noise_std);
    if (!std::isfinite(gain) || !std::isfinite(step_height))
        throw InvalidArgument("The gain and the height of the first-order step must be finite numbers");
    if (samples < 2)
        throw InvalidArgument("The number of samples of the first-order step must be at least 2, but is {}", samples);
}

FirstOrderStepTruth first_order_step_truth(const FirstOrderStepParameters& p) {
    p.validate();
    const double f = std::exp(-p.Ts / p.time_constant);
    return {-1 / p.time_constant, p.gain / p.time_constant, f, p.gain * (1 - f)};
}

FirstOrderStepData simulate_first_order_step(const FirstOrderStepParameters& p, std::uint32_t seed) {
    p.validate();
    FirstOrderStepData data_set;
    data_set.t = Vector::LinSpaced(p.samples, 0, static_cast<double>(p.samples - 1)) * p.Ts;
    data_set.u = Vector::Constant(p.samples, p.step_height);
    const double final_output = p.gain * p.step_height;
    const Vector decay = (-data_set.t.array() / p.time_constant).exp();
    data_set.y = final_output * (1 - decay.array());
    data_set.ydot = final_output / p.time_constant * decay;
    RandomStream random(seed);
    data_set.y_noisy = measure(data_set.y, p.output_noise_std, 0, random);
    data_set.ydot_noisy = measure(data_set.ydot, p.derivative_noise_std, 0, random);
    return data_set;
}

}  // namespace dynlab::inline numerics
