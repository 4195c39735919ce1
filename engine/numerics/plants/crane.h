#pragma once
#include "numerics/simulation/ode_solver.h"

namespace dynlab::inline numerics {

/// A trolley crane of laboratory size: a direct-current motor drives a trolley along a rail by a toothed belt; a
/// pendulum hangs from the trolley. With x the trolley's position, z that of the belt at the motor, phi the pendulum's
/// angle from hanging (the load at x + l sin phi), i the current:
///     L di/dt = sat(u) - R i - K dz/dt,                          K = torque_constant gear_ratio/pulley_radius
///     m_r d2z/dt2 = K i - motor_damping dz/dt - F,               m_r = rotor_inertia (gear_ratio/pulley_radius)^2
///     F = belt_stiffness (z - x) + belt_damping (dz/dt - dx/dt)
///     (M + m) d2x/dt2 + m l cos(phi) d2phi/dt2 - m l sin(phi) (dphi/dt)^2 = F - trolley_damping dx/dt - D + B
///     m l cos(phi) d2x/dt2 + (I + m l^2) d2phi/dt2 + m g l sin(phi) = -(pivot_damping + air_drag |dphi/dt|) dphi/dt.
/// Dry friction D: a resting trolley holds forces up to static_friction; a moving one is braked by
///     coulomb_friction + (static_friction - coulomb_friction) exp(-(dx/dt / stribeck_speed)^2).
/// Rubber buffers beyond +-rail give B = -buffer_stiffness d (1 + buffer_damping dd/dt), d the compression
/// (Hunt and Crossley 1975), and never pull. sat limits the voltage to +-voltage_limit.
struct CraneParameters {
    double resistance = 5;           ///< R, ohm
    double inductance = 5e-3;        ///< L, H
    double torque_constant = 0.05;   ///< N m/A, and V s/rad
    double gear_ratio = 5;           ///< turns of the motor per turn of the pulley
    double pulley_radius = 0.02;     ///< m
    double rotor_inertia = 2e-5;     ///< of motor, gear and pulley, seen at the motor, kg m^2
    double motor_damping = 2;        ///< seen at the belt, N s/m
    double belt_stiffness = 4e4;     ///< N/m
    double belt_damping = 30;        ///< N s/m
    double trolley_mass = 1;         ///< M, kg
    double trolley_damping = 3;      ///< N s/m
    double coulomb_friction = 0.6;   ///< N
    double static_friction = 0.85;   ///< N
    double stribeck_speed = 0.01;    ///< m/s
    double pendulum_mass = 0.23;     ///< m, kg
    double pendulum_length = 0.36;   ///< l, from the pivot to the center of mass, m
    double pendulum_inertia = 1e-3;  ///< I, about the center of mass, kg m^2
    double pivot_damping = 3e-3;     ///< N m s
    double air_drag = 8e-4;          ///< N m s^2
    double gravity = 9.81;           ///< g, m/s^2
    double rail = 0.5;               ///< m from the middle to each buffer
    double buffer_stiffness = 2e4;   ///< N/m
    double buffer_damping = 0.8;     ///< s/m
    double voltage_limit = 10;       ///< of the amplifier, V

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

struct CraneState {
    double motor_position = 0;  ///< z, m
    double motor_speed = 0;     ///< m/s
    double position = 0;        ///< x, m
    double speed = 0;           ///< m/s
    double angle = 0;           ///< phi, rad
    double angle_rate = 0;      ///< rad/s
    double current = 0;         ///< A
};

/// What theory says of the crane.
struct CraneTruth {
    double natural_frequency;  ///< of small swings with the trolley held, sqrt(m g l/(I + m l^2)), rad/s
    double damping_ratio;      ///< of the same, from pivot_damping
    double speed_gain;         ///< steady speed per volt beyond dry_voltage, m/(s V)
    double dry_voltage;        ///< what Coulomb friction takes of the voltage while the trolley moves, V
    double starting_voltage;   ///< below it a resting trolley stays, V
    double time_constant;      ///< of the speed: belt and pendulum rigid, no inductance, s
};
/// True values of the quantities that the data show, computed from the parameters. Throws InvalidArgument as their
/// validate().
CraneTruth crane_truth(const CraneParameters& parameters);

/// The crane in motion. Sliding either way, sticking and touching a buffer are separate forms of the equations; each
/// change is located as an event.
class CraneSimulator {
  public:
    /// Throws InvalidArgument for parameters or a state that are not physical.
    explicit CraneSimulator(const CraneParameters& parameters, const CraneState& start = {},
                            const OdeOptions& options = {});
    CraneSimulator(const CraneSimulator&) = delete;
    CraneSimulator& operator=(const CraneSimulator&) = delete;

    /// Holds `voltage` (V, limited by the amplifier) for `duration` (s).
    void advance(double voltage, double duration);
    CraneState state() const;
    bool sticks() const { return sliding_ == 0; }

  private:
    OdeState rate(const OdeState& x) const;
    OdeState guard(const OdeState& x) const;
    void change_form();
    double belt_force(const OdeState& x) const;
    double buffer_force(const OdeState& x) const;
    double sliding_friction(double speed) const;
    double swing_torque(const OdeState& x) const;
    double holding_force(const OdeState& x) const;  ///< what friction must hold at rest, N

    CraneParameters p_;
    OdeState x_;
    double voltage_ = 0;
    int sliding_ = 0;  ///< direction of sliding, 0 when the trolley sticks
    int buffer_ = 0;   ///< 1 or -1 when the buffer at that end is touched
    OdeSolver solver_;
};

}  // namespace dynlab::inline numerics
