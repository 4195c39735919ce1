#include "numerics/plants/two_tanks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/plants/plant_data.h"
#include "numerics/simulation/ode_solver.h"

namespace dynlab::inline numerics {
namespace {

double root(double level) {
    return std::sqrt(std::max(level, 0.));
}

/// Full or not are separate forms of the equations; each change is located as an event.
class TankSimulator {
  public:
    TankSimulator(const TwoTanksParameters& p, const std::array<double, 2>& start)
        : p_(p),
          x_{{start[0], start[1]}},
          solver_([this](double, const OdeState& x) { return rate(x); },
                  {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-10, .first_step = 0.01}) {}
    TankSimulator(const TankSimulator&) = delete;
    TankSimulator& operator=(const TankSimulator&) = delete;

    void advance(double voltage, double duration) {
        inflow_ = p_.k4 * voltage;
        double t = 0;
        do {
            x_ = x_.cwiseMin(p_.height);
            upper_full_ = x_[0] >= p_.height && inflow_ >= p_.k1 * root(p_.height);
            lower_full_ = false;
            lower_full_ = x_[1] >= p_.height && rate(x_)[1] >= 0;
        } while (solver_.advance(t, x_, duration, [this](double, const OdeState& x) { return guard(x); }));
    }
    const OdeState& levels() const { return x_; }

  private:
    double into_lower(const OdeState& x) const {
        const double out = p_.k1 * root(x[0]);
        return p_.k2 * root(x[0]) + (upper_full_ ? p_.overflow_part * (inflow_ - out) : 0.);
    }
    OdeState rate(const OdeState& x) const {
        return OdeState{
            {upper_full_ ? 0. : inflow_ - p_.k1 * root(x[0]), lower_full_ ? 0. : into_lower(x) - p_.k3 * root(x[1])}};
    }
    /// What a tank that is not full has left, or what a full one is given beyond what it lets out. That of the upper
    /// tank is constant while the voltage is held.
    OdeState guard(const OdeState& x) const {
        return OdeState{{upper_full_ ? 1. : p_.height - x[0],
                         lower_full_ ? into_lower(x) - p_.k3 * root(p_.height) : p_.height - x[1]}};
    }

    TwoTanksParameters p_;
    OdeState x_;
    double inflow_ = 0;
    bool upper_full_ = false, lower_full_ = false;
    OdeSolver solver_;
};

Vector multisine_voltage(const TwoTanksExperiments& plan, RandomStream& random) {
    const Index N = plan.samples;
    Vector sum = Vector::Zero(N);
    for (int line = 1; line <= plan.lines; ++line) {
        const double w = 2 * std::numbers::pi * line / static_cast<double>(N);
        const double phase = 2 * std::numbers::pi * random.uniform();
        for (Index k = 0; k < N; ++k) sum[k] += std::cos(w * static_cast<double>(k) + phase);
    }
    const double scale = plan.voltage_std / std::sqrt(plan.lines / 2.);
    return (plan.mean_voltage + scale * sum.array()).max(0.).min(plan.greatest_voltage);
}

PlantData data_of(const TwoTanksParameters& p, const TwoTanksExperiments& plan, RandomStream& random) {
    const TwoTanksTruth start = two_tanks_truth(p, plan.start_voltage);
    PlantData data_set;
    data_set.u = multisine_voltage(plan, random);
    data_set.t = Vector::LinSpaced(plan.samples, 0, plan.samples - 1.) * plan.Ts;
    const Matrix levels = two_tanks_levels(p, data_set.u, plan.Ts, {start.upper_level, start.lower_level});
    const Vector volts = p.sensor_offset + p.sensor_gain * levels.col(1).array();
    data_set.y = measure(volts, p.noise_std, p.resolution, random);
    return data_set;
}

}  // namespace

void TwoTanksParameters::validate() const {
    const char* plant = "two tanks";
    require_positive(plant, "k1", k1, "k2", k2, "k3", k3, "k4", k4, "height", height, "sensor gain", sensor_gain);
    require_not_negative(plant, "overflow part", overflow_part, "sensor offset's size", std::abs(sensor_offset),
                         "noise standard deviation", noise_std, "resolution", resolution,
                         "overflow part's distance from 1", 1 - overflow_part);
}

void TwoTanksExperiments::validate() const {
    const char* plant = "two tanks";
    require_not_negative(plant, "mean voltage", mean_voltage, "start voltage", start_voltage);
    require_positive(plant, "sampling time", Ts, "number of samples", samples, "number of lines", lines,
                     "voltage's standard deviation", voltage_std, "greatest voltage", greatest_voltage,
                     "number of samples beyond two a period of the highest line", samples - 2. * lines);
}

TwoTanksTruth two_tanks_truth(const TwoTanksParameters& p, double voltage) {
    p.validate();
    require_positive("two tanks", "voltage", voltage);
    TwoTanksTruth truth;
    truth.upper_level = std::pow(p.k4 * voltage / p.k1, 2);
    truth.lower_level = std::pow(p.k2 / p.k3, 2) * truth.upper_level;
    require_positive("two tanks", "height above the levels", p.height - std::max(truth.upper_level, truth.lower_level));
    truth.output = p.sensor_offset + p.sensor_gain * truth.lower_level;
    truth.gain = 2 * p.sensor_gain * truth.lower_level / voltage;
    truth.upper = 2 * root(truth.upper_level) / p.k1;
    truth.lower = 2 * root(truth.lower_level) / p.k3;
    return truth;
}

Matrix two_tanks_levels(const TwoTanksParameters& p, const Vector& voltage, double Ts,
                        const std::array<double, 2>& start) {
    p.validate();
    require_positive("two tanks", "sampling time", Ts);
    if (voltage.size() == 0 || !voltage.allFinite())
        throw InvalidArgument(
            "The voltages of the two tanks must have at least one sample, and every sample must be finite");
    require_not_negative("two tanks", "lowest voltage", voltage.minCoeff());
    for (double level : start) {
        require_not_negative("two tanks", "start level", level);
        require_not_negative("two tanks", "height above the start level", p.height - level);
    }
    TankSimulator tanks(p, start);
    Matrix levels(voltage.size(), 2);
    for (Index k = 0; k < voltage.size(); ++k) {
        levels.row(k) = tanks.levels().transpose();
        tanks.advance(voltage[k], Ts);
    }
    return levels;
}

TwoTanksData simulate_two_tanks(const TwoTanksParameters& parameters, const TwoTanksExperiments& experiments,
                                std::uint32_t seed) {
    parameters.validate();
    experiments.validate();
    RandomStream random(seed);
    TwoTanksData data_sets;
    data_sets.estimation = data_of(parameters, experiments, random);
    data_sets.validation = data_of(parameters, experiments, random);
    return data_sets;
}

}  // namespace dynlab::inline numerics
