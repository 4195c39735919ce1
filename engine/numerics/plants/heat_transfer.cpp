#include "numerics/plants/heat_transfer.h"

#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/plants/plant_data.h"
#include "numerics/simulation/ode_solver.h"

namespace dynlab::inline numerics {
namespace {

double heating(const HeatTransferParameters& p, double voltage) {
    const double part = voltage / p.full_voltage;
    return p.power * part * part;
}

PlantData data_about(const HeatTransferParameters& p, const HeatTransferExperiments& plan, double operating_point,
                     RandomStream& random) {
    const auto rest = static_cast<Index>(std::llround(plan.rest / plan.Ts));
    const Vector bits = seeded_prbs(plan.prbs_stages, plan.prbs_hold, operating_point - plan.amplitude,
                                    operating_point + plan.amplitude, random);
    PlantData data_set;
    data_set.u.resize(rest + bits.size());
    data_set.u << Vector::Constant(rest, operating_point), bits;
    data_set.t = Vector::LinSpaced(data_set.u.size(), 0, static_cast<double>(data_set.u.size() - 1)) * plan.Ts;
    data_set.y = simulate_heat_transfer(p, data_set.u, plan.Ts, random);
    return data_set;
}

}  // namespace

void HeatTransferParameters::validate() const {
    const char* plant = "heat-transfer plant";
    require_positive(plant, "heater capacity", heater_capacity, "air capacity", air_capacity, "transfer", transfer,
                     "flow", flow, "power", power, "full voltage", full_voltage, "sensor time", sensor_time,
                     "drift period", drift_period);
    require_not_negative(plant, "dead time", dead_time, "inlet temperature's size", std::abs(inlet), "drift", drift,
                         "noise standard deviation", noise_std, "resolution", resolution);
}

void HeatTransferExperiments::validate() const {
    const char* plant = "heat-transfer plant";
    require_positive(plant, "sampling time", Ts, "amplitude", amplitude);
    require_not_negative(plant, "rest", rest, "lowest voltage", std::min(low, high) - amplitude);
}

HeatTransferTruth heat_transfer_truth(const HeatTransferParameters& p, double operating_point) {
    p.validate();
    // Heater and air: s^2 + sum s + product, both poles real.
    const double sum = p.transfer / p.heater_capacity + (p.transfer + p.flow) / p.air_capacity;
    const double product = p.transfer * p.flow / (p.heater_capacity * p.air_capacity);
    const double fast_pole = (sum + std::sqrt(sum * sum - 4 * product)) / 2;
    HeatTransferTruth truth;
    truth.temperature = p.inlet + heating(p, operating_point) / p.flow;
    truth.gain = 2 * p.power * operating_point / (p.full_voltage * p.full_voltage) / p.flow;
    truth.fast = 1 / fast_pole;
    truth.slow = fast_pole / product;
    return truth;
}

Vector simulate_heat_transfer(const HeatTransferParameters& p, const Vector& u, double Ts, RandomStream& random) {
    p.validate();
    require_positive("heat-transfer plant", "sampling time", Ts);
    if (u.size() == 0 || !u.allFinite())
        throw InvalidArgument(
            "The voltages of the heat-transfer plant must have at least one sample, and every sample must be finite");
    const double w = 2 * std::numbers::pi / p.drift_period, phase = 2 * std::numbers::pi * random.uniform();
    // The plant is linear in heating power and inlet temperature, so that both can be delayed instead of the air.
    double power = heating(p, u[0]);
    OdeSolver solver(
        [&](double t, const OdeState& x) {
            const double inlet = p.inlet + p.drift * std::sin(w * t + phase), given = p.transfer * (x[0] - x[1]);
            return OdeState{{(power - given) / p.heater_capacity, (given - p.flow * (x[1] - inlet)) / p.air_capacity,
                             (x[1] - x[2]) / p.sensor_time}};
        },
        {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-10, .first_step = 0.01});
    const double air = p.inlet + p.drift * std::sin(phase) + power / p.flow;
    OdeState x{{air + power / p.transfer, air, air}};
    Vector temperature(u.size());
    double t = 0;
    for (Index k = 0; k < u.size(); ++k) {
        temperature[k] = x[2];
        over_interval(u, k, p.dead_time, Ts, [&](double voltage, double duration) {
            power = heating(p, voltage);
            solver.advance(t, x, t + duration);
        });
    }
    return measure(temperature, p.noise_std, p.resolution, random);
}

HeatTransferData simulate_heat_transfer(const HeatTransferParameters& parameters,
                                        const HeatTransferExperiments& experiments, std::uint32_t seed) {
    experiments.validate();
    RandomStream random(seed);
    HeatTransferData data_sets;
    data_sets.estimation = data_about(parameters, experiments, experiments.low, random);
    data_sets.validation = data_about(parameters, experiments, experiments.low, random);
    data_sets.high = data_about(parameters, experiments, experiments.high, random);
    return data_sets;
}

}  // namespace dynlab::inline numerics
