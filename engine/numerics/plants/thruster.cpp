#include "numerics/plants/thruster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/number_text.h"
#include "numerics/error.h"
#include "numerics/linalg/side_by_side.h"
#include "numerics/plants/plant_data.h"
#include "numerics/signals/excitation.h"
#include "numerics/simulation/ode_solver.h"

namespace dynlab::inline numerics {
namespace {

enum : Index { kThrusterSpeed, kReading, kReadingRate, kThrusterStates };

double voltage_of(const ThrusterParameters& p, double width) {
    const double beyond = std::max(0., std::abs(width - p.neutral) - p.dead_band);
    return std::copysign(p.supply * beyond / (p.full_width - p.dead_band), width - p.neutral);
}

double thrust_of_speed(const ThrusterParameters& p, double speed) {
    return (speed > 0 ? p.forward_thrust : p.reverse_thrust) * speed * std::abs(speed);
}

/// First-order Gauss-Markov noise of variance one, of white noise of that variance.
Vector turbulence(Vector noise, double Ts, double correlation_time) {
    const double kept = std::exp(-Ts / correlation_time), fresh = std::sqrt(1 - kept * kept);
    for (Index k = 1; k < noise.size(); ++k) noise[k] = kept * noise[k - 1] + fresh * noise[k];
    return noise;
}

/// The random numbers of one experiment, white and of variance one.
struct ThrusterNormals {
    ThrusterNormals(Index count, RandomStream& random) : wake(random.normal(count)), sensor(random.normal(count)) {}
    Vector wake, sensor;
};

Vector readings(const ThrusterParameters& p, const Vector& pwm, double Ts, const ThrusterNormals& normals) {
    const Vector wake = turbulence(normals.wake, Ts, p.wake_time);
    double voltage = 0, eddy = 0;
    const double w = 2 * std::numbers::pi * p.cell_frequency;
    OdeSolver solver(
        [&](double, const OdeState& x) {
            const double speed = x[kThrusterSpeed], thrust = thrust_of_speed(p, speed);
            const double torque = p.motor_constant * (voltage - p.motor_constant * speed) / p.resistance;
            const double force = thrust + p.wake * std::abs(thrust) * eddy;
            return OdeState{{(torque - p.drag_torque * speed * std::abs(speed)) / p.inertia, x[kReadingRate],
                             w * w * (force - x[kReading]) - 2 * p.cell_damping * w * x[kReadingRate]}};
        },
        {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-9});
    OdeState x = OdeState::Zero(kThrusterStates);
    Vector truth(pwm.size());
    for (Index k = 0; k < pwm.size(); ++k) {
        truth[k] = x[kReading] + p.tare;
        eddy = wake[k];
        over_interval(pwm, k, p.delay, Ts, [&](double width, double duration) {
            voltage = voltage_of(p, width);
            double t = 0;
            solver.advance(t, x, duration);
        });
    }
    return measure(truth, p.noise_std, p.resolution, normals.sensor);
}

Vector chirp_about_neutral(const ThrusterParameters& p, const ThrusterExperiments& plan, ChirpShape shape,
                           double amplitude) {
    const Vector wave = chirp(plan.start_frequency, plan.end_frequency, plan.duration, plan.Ts, shape);
    const auto rest = static_cast<Index>(std::llround(plan.rest / plan.Ts));
    Vector pwm = Vector::Constant(wave.size() + 2 * rest, p.neutral);
    pwm.segment(rest, wave.size()) = (p.neutral + amplitude * wave.array()).round();
    return pwm;
}

}  // namespace

void ThrusterParameters::validate() const {
    const char* plant = "thruster";
    require_not_negative(plant, "dead band", dead_band, "delay", delay, "load cell's damping", cell_damping, "wake",
                         wake, "noise standard deviation", noise_std, "resolution", resolution, "tare's size",
                         std::abs(tare));
    require_positive(plant, "neutral pulse width", neutral, "supply", supply, "motor constant", motor_constant,
                     "resistance", resistance, "inertia", inertia, "drag torque", drag_torque, "forward thrust",
                     forward_thrust, "reverse thrust", reverse_thrust, "load cell's frequency", cell_frequency,
                     "wake's correlation time", wake_time, "full width outside the dead band", full_width - dead_band);
}

void ThrusterExperiments::validate() const {
    const char* plant = "thruster";
    require_positive(plant, "sampling time", Ts, "start frequency", start_frequency, "end frequency", end_frequency,
                     "duration", duration);
    require_not_negative(plant, "rest", rest);
    for (double amplitude : amplitudes) require_positive(plant, "amplitude", amplitude);
}

double thruster_speed(const ThrusterParameters& p, double width) {
    p.validate();
    const double voltage = voltage_of(p, width);
    // drag n^2 + K^2/R n - K |V|/R = 0, by the form of the root that does not cancel.
    const double b = p.motor_constant * p.motor_constant / p.resistance;
    const double c = p.motor_constant * std::abs(voltage) / p.resistance;
    return std::copysign(2 * c / (b + std::sqrt(b * b + 4 * p.drag_torque * c)), voltage);
}

double thruster_thrust(const ThrusterParameters& p, double width) {
    return thrust_of_speed(p, thruster_speed(p, width));
}

ThrusterTruth thruster_truth(const ThrusterParameters& p) {
    const double b = p.motor_constant * p.motor_constant / p.resistance;
    const double top_speed = thruster_speed(p, p.neutral + p.full_width);
    return {p.delay, thrust_of_speed(p, top_speed), thruster_thrust(p, p.neutral - p.full_width), p.inertia / b,
            p.inertia / (b + 2 * p.drag_torque * top_speed)};
}

Vector simulate_thruster(const ThrusterParameters& parameters, const Vector& pwm, double Ts, std::uint32_t seed) {
    parameters.validate();
    require_positive("thruster", "sampling time", Ts);
    if (pwm.size() == 0 || !pwm.allFinite())
        throw InvalidArgument(
            "The pulse width of the thruster must have at least one sample, and every sample must be finite");
    RandomStream random(seed);
    return readings(parameters, pwm, Ts, {pwm.size(), random});
}

std::vector<ThrusterData> simulate_thruster(const ThrusterParameters& parameters,
                                            const ThrusterExperiments& experiments, std::uint32_t seed) {
    parameters.validate();
    experiments.validate();
    RandomStream random(seed);
    // All random numbers are drawn in the order of the experiments; after that each experiment can be simulated
    // separately.
    std::vector<ThrusterData> data_sets;
    std::vector<ThrusterNormals> normals;
    for (const ChirpShape shape : {ChirpShape::kSine, ChirpShape::kSquare}) {
        for (const double amplitude : experiments.amplitudes) {
            ThrusterData data_set;
            data_set.name = (shape == ChirpShape::kSine ? "sine_" : "square_") + number_text(amplitude);
            data_set.pwm = chirp_about_neutral(parameters, experiments, shape, amplitude);
            const Index N = data_set.pwm.size();
            data_set.t = Vector::LinSpaced(N, 0, static_cast<double>(N - 1)) * experiments.Ts;
            normals.emplace_back(N, random);
            data_sets.push_back(std::move(data_set));
        }
    }
    side_by_side(data_sets.size(), [&](std::size_t i) {
        data_sets[i].force = readings(parameters, data_sets[i].pwm, experiments.Ts, normals[i]);
    });
    return data_sets;
}

}  // namespace dynlab::inline numerics
