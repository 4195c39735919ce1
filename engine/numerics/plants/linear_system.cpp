#include "numerics/plants/linear_system.h"

#include "numerics/plants/plant_data.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::inline numerics {
namespace {

PlantData data_of(const LinearSystemParameters& p, const TransferFunction& G, RandomStream& random) {
    PlantData data_set;
    data_set.u = seeded_prbs(p.prbs_stages, p.prbs_hold, -p.amplitude, p.amplitude, random);
    data_set.t = Vector::LinSpaced(data_set.u.size(), 0, static_cast<double>(data_set.u.size() - 1)) * p.Ts;
    data_set.y = measure(lsim(G, data_set.u, p.Ts), p.noise_std, 0, random);
    return data_set;
}

}  // namespace

void LinearSystemParameters::validate() const {
    const char* plant = "linear system";
    require_positive(plant, "gain", gain, "zero", zero, "pole", pole, "frequency", frequency, "damping", damping,
                     "amplitude", amplitude, "sampling time", Ts);
    require_not_negative(plant, "noise standard deviation", noise_std);
}

TransferFunction linear_system_truth(const LinearSystemParameters& p) {
    p.validate();
    const double w = p.frequency, first = 2 * p.damping * w, scale = p.gain * p.pole * w * w / p.zero;
    return TransferFunction(Vector{{scale, scale * p.zero}},
                            Vector{{1, first + p.pole, w * w + first * p.pole, p.pole * w * w}});
}

LinearSystemData simulate_linear_system(const LinearSystemParameters& parameters, std::uint32_t seed) {
    const TransferFunction G = linear_system_truth(parameters);
    RandomStream random(seed);
    LinearSystemData data_sets;
    data_sets.estimation = data_of(parameters, G, random);
    data_sets.validation = data_of(parameters, G, random);
    return data_sets;
}

}  // namespace dynlab::inline numerics
