#include "numerics/plants/crane.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {
namespace {

/// Places in the integrator's state.
enum : Index { kMotorPosition, kMotorSpeed, kPosition, kSpeed, kAngle, kAngleRate, kCurrent, kStates };

/// Volts per speed of the belt, and newtons per ampere.
double motor_constant(const CraneParameters& p) {
    return p.torque_constant * p.gear_ratio / p.pulley_radius;
}

double motor_mass(const CraneParameters& p) {
    return p.rotor_inertia * std::pow(p.gear_ratio / p.pulley_radius, 2);
}

double inertia_at_pivot(const CraneParameters& p) {
    return p.pendulum_inertia + p.pendulum_mass * p.pendulum_length * p.pendulum_length;
}

double lever(const CraneParameters& p) {
    return p.pendulum_mass * p.pendulum_length;
}

int sign(double value) {
    return value > 0 ? 1 : -1;
}

OdeState packed(const CraneState& s) {
    OdeState x(kStates);
    x << s.motor_position, s.motor_speed, s.position, s.speed, s.angle, s.angle_rate, s.current;
    return x;
}

}  // namespace

void CraneParameters::validate() const {
    const char* plant = "crane";
    require_positive(plant, "resistance", resistance, "inductance", inductance, "gear ratio", gear_ratio,
                     "pulley radius", pulley_radius, "rotor inertia", rotor_inertia, "belt stiffness", belt_stiffness,
                     "trolley mass", trolley_mass, "Stribeck speed", stribeck_speed, "pendulum mass", pendulum_mass,
                     "pendulum length", pendulum_length, "gravity", gravity, "rail", rail, "buffer stiffness",
                     buffer_stiffness, "voltage limit", voltage_limit);
    require_not_negative(plant, "torque constant", torque_constant, "motor damping", motor_damping, "belt damping",
                         belt_damping, "trolley damping", trolley_damping, "Coulomb friction", coulomb_friction,
                         "pendulum inertia", pendulum_inertia, "pivot damping", pivot_damping, "air drag", air_drag,
                         "buffer damping", buffer_damping, "surplus of static over Coulomb friction",
                         static_friction - coulomb_friction);
}

CraneTruth crane_truth(const CraneParameters& p) {
    p.validate();
    require_positive("crane", "torque constant", p.torque_constant);
    const double K = motor_constant(p), J = inertia_at_pivot(p), stiffness = lever(p) * p.gravity;
    const double damping = K * K / p.resistance + p.motor_damping + p.trolley_damping;
    CraneTruth truth;
    truth.natural_frequency = std::sqrt(stiffness / J);
    truth.damping_ratio = p.pivot_damping / (2 * std::sqrt(stiffness * J));
    truth.speed_gain = K / p.resistance / damping;
    truth.dry_voltage = p.coulomb_friction * p.resistance / K;
    truth.starting_voltage = p.static_friction * p.resistance / K;
    truth.time_constant = (motor_mass(p) + p.trolley_mass + p.pendulum_mass) / damping;
    return truth;
}

CraneSimulator::CraneSimulator(const CraneParameters& parameters, const CraneState& start, const OdeOptions& options)
    : p_(parameters), x_(packed(start)), solver_([this](double, const OdeState& x) { return rate(x); }, options) {
    p_.validate();
    if (!x_.allFinite()) throw InvalidArgument("The initial state of the crane must contain only finite numbers");
    if (start.speed != 0) sliding_ = sign(start.speed);
    if (std::abs(start.position) > p_.rail) buffer_ = sign(start.position);
}

CraneState CraneSimulator::state() const {
    return {x_[kMotorPosition], x_[kMotorSpeed], x_[kPosition], x_[kSpeed], x_[kAngle], x_[kAngleRate], x_[kCurrent]};
}

double CraneSimulator::belt_force(const OdeState& x) const {
    return p_.belt_stiffness * (x[kMotorPosition] - x[kPosition]) + p_.belt_damping * (x[kMotorSpeed] - x[kSpeed]);
}

double CraneSimulator::buffer_force(const OdeState& x) const {
    if (buffer_ == 0) return 0;
    const double compression = buffer_ * x[kPosition] - p_.rail, rate = buffer_ * x[kSpeed];
    return -buffer_ * p_.buffer_stiffness * compression * std::max(0., 1 + p_.buffer_damping * rate);
}

double CraneSimulator::sliding_friction(double speed) const {
    const double surplus = p_.static_friction - p_.coulomb_friction, part = speed / p_.stribeck_speed;
    return p_.coulomb_friction + surplus * std::exp(-part * part);
}

double CraneSimulator::swing_torque(const OdeState& x) const {
    const double rate = x[kAngleRate];
    return -lever(p_) * p_.gravity * std::sin(x[kAngle]) - (p_.pivot_damping + p_.air_drag * std::abs(rate)) * rate;
}

double CraneSimulator::holding_force(const OdeState& x) const {
    const double rate = x[kAngleRate], acceleration = swing_torque(x) / inertia_at_pivot(p_);
    return belt_force(x) + buffer_force(x) +
           lever(p_) * (std::sin(x[kAngle]) * rate * rate - std::cos(x[kAngle]) * acceleration);
}

OdeState CraneSimulator::rate(const OdeState& x) const {
    const double K = motor_constant(p_), F = belt_force(x), J = inertia_at_pivot(p_), torque = swing_torque(x);
    OdeState dx(kStates);
    dx[kMotorPosition] = x[kMotorSpeed];
    dx[kMotorSpeed] = (K * x[kCurrent] - p_.motor_damping * x[kMotorSpeed] - F) / motor_mass(p_);
    dx[kCurrent] = (voltage_ - p_.resistance * x[kCurrent] - K * x[kMotorSpeed]) / p_.inductance;
    dx[kAngle] = x[kAngleRate];
    if (sliding_ == 0) {
        dx[kPosition] = dx[kSpeed] = 0;
        dx[kAngleRate] = torque / J;
        return dx;
    }
    const double speed = x[kSpeed], coupling = lever(p_) * std::cos(x[kAngle]);
    const double force = F + buffer_force(x) - p_.trolley_damping * speed - sliding_ * sliding_friction(speed) +
                         lever(p_) * std::sin(x[kAngle]) * x[kAngleRate] * x[kAngleRate];
    const double mass = p_.trolley_mass + p_.pendulum_mass, determinant = mass * J - coupling * coupling;
    dx[kPosition] = speed;
    dx[kSpeed] = (J * force - coupling * torque) / determinant;
    dx[kAngleRate] = (mass * torque - coupling * force) / determinant;
    return dx;
}

OdeState CraneSimulator::guard(const OdeState& x) const {
    OdeState values(3);
    values[0] = sliding_ == 0 ? p_.static_friction - std::abs(holding_force(x)) : sliding_ * x[kSpeed];
    const double right = x[kPosition] - p_.rail, left = -x[kPosition] - p_.rail;
    values[1] = buffer_ == 1 ? right : -right;
    values[2] = buffer_ == -1 ? left : -left;
    return values;
}

void CraneSimulator::change_form() {
    const OdeState values = guard(x_);
    if (values[1] < 0) buffer_ = buffer_ == 1 ? 0 : 1;
    if (values[2] < 0) buffer_ = buffer_ == -1 ? 0 : -1;
    if (values[0] >= 0) return;
    x_[kSpeed] = 0;
    const double force = holding_force(x_);
    sliding_ = std::abs(force) <= p_.static_friction ? 0 : sign(force);
}

void CraneSimulator::advance(double voltage, double duration) {
    voltage_ = std::clamp(voltage, -p_.voltage_limit, p_.voltage_limit);
    double t = 0;
    while (solver_.advance(t, x_, duration, [this](double, const OdeState& x) { return guard(x); })) change_form();
}

}  // namespace dynlab::inline numerics
