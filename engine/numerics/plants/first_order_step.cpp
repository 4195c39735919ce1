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
        throw InvalidArgument("The first-order step needs at least 2 samples, but {} were requested", samples);
}

FirstOrderStepTruth first_order_step_truth(const FirstOrderStepParameters& p) {
    p.validate();
    const double f = std::exp(-p.Ts / p.time_constant);
    return {-1 / p.time_constant, p.gain / p.time_constant, f, p.gain * (1 - f)};
}

FirstOrderStepRecord simulate_first_order_step(const FirstOrderStepParameters& p, std::uint32_t seed) {
    p.validate();
    FirstOrderStepRecord record;
    record.t = Vector::LinSpaced(p.samples, 0, static_cast<double>(p.samples - 1)) * p.Ts;
    record.u = Vector::Constant(p.samples, p.step_height);
    const double final_output = p.gain * p.step_height;
    const Vector decay = (-record.t.array() / p.time_constant).exp();
    record.y = final_output * (1 - decay.array());
    record.ydot = final_output / p.time_constant * decay;
    RandomStream random(seed);
    record.y_noisy = measure(record.y, p.output_noise_std, 0, random);
    record.ydot_noisy = measure(record.ydot, p.derivative_noise_std, 0, random);
    return record;
}

}  // namespace dynlab::inline numerics
