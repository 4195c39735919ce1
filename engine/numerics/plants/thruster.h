#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// An underwater thruster on a load cell: a speed controller turns the width p of its pulses into a voltage, after a
/// delay; a brushless motor drives a propeller; a bending beam that can swing measures the thrust T:
///     V = supply sign(p - neutral) max(0, |p - neutral| - dead_band)/(full_width - dead_band)
///     J dn/dt = K (V(t - delay) - K n)/R - drag_torque n |n|
///     T = forward_thrust n^2 (n > 0), -reverse_thrust n^2 (n < 0)
///     d2y/dt2 + 2 cell_damping w dy/dt + w^2 y = w^2 (T + wake |T| e),      w = 2 pi cell_frequency,
/// e the turbulence of the wake: first-order Gauss-Markov noise of variance one, held between samples. The load cell's
/// reading is y + tare, with white noise, rounded. At full width and 12 V the values below give 36.4 N forwards, 28.6 N
/// backwards and 16 A, the performance that Blue Robotics publishes for its T200 (3.71 kgf, 2.92 kgf, 17 A).
struct ThrusterParameters {
    double neutral = 1500;             ///< microseconds
    double dead_band = 25;             ///< to either side of neutral, microseconds
    double full_width = 400;           ///< from neutral to full voltage, microseconds
    double supply = 12;                ///< V
    double delay = 0.031;              ///< of radio frame and speed controller, s
    double motor_constant = 0.0195;    ///< K, N m/A and V s/rad
    double resistance = 0.363;         ///< R, of motor, controller and leads, ohm
    double inertia = 1.2e-4;           ///< J, of rotor, propeller and the water it takes along, kg m^2
    double drag_torque = 3.24e-6;      ///< N m s^2
    double forward_thrust = 3.719e-4;  ///< N s^2
    double reverse_thrust = 2.927e-4;  ///< N s^2
    double cell_frequency = 18;        ///< of beam and thruster, Hz
    double cell_damping = 0.06;
    double wake = 0.03;        ///< standard deviation of turbulence, part of the thrust
    double wake_time = 0.1;    ///< its correlation time, s
    double noise_std = 0.25;   ///< of the reading, N
    double resolution = 0.02;  ///< of the reading, N; 0 for none
    double tare = 0.3;         ///< reading at rest, N

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// Steady speed (rad/s) and thrust (N) at pulse width p, without turbulence: the positive root of a quadratic equation.
double thruster_speed(const ThrusterParameters& parameters, double p);
double thruster_thrust(const ThrusterParameters& parameters, double p);

struct ThrusterTruth {
    double delay;                           ///< s
    double forward_thrust, reverse_thrust;  ///< at full width, N (the second one negative)
    double slow_time_constant;              ///< of the speed at rest, J R/K^2, s
    double fast_time_constant;              ///< of small changes of the speed at full width forwards, s
};
/// True values of the quantities that the data show, computed from the parameters. Throws InvalidArgument as their
/// validate().
ThrusterTruth thruster_truth(const ThrusterParameters& parameters);

/// Chirps about neutral, each between two rests at neutral.
struct ThrusterExperiments {
    double Ts = 0.002;                                 ///< s; the pulse width is held between samples
    double start_frequency = 0.1, end_frequency = 3;   ///< Hz, swept linearly
    double duration = 20;                              ///< of a chirp, s
    double rest = 0.5;                                 ///< before and after it, s
    std::vector<double> amplitudes = {100, 200, 300};  ///< microseconds

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// Instants (s), pulse widths (whole microseconds) and readings of the load cell (N), N values each.
struct ThrusterData {
    std::string name;  ///< sine_100, square_100, ...: shape and amplitude
    Vector t, pwm, force;
};

/// Readings to a given sequence of pulse widths, from rest; equal seeds give equal ones.
Vector simulate_thruster(const ThrusterParameters& parameters, const Vector& pwm, double Ts, std::uint32_t seed);

/// A sine and a square chirp of every amplitude, each with independent noise; equal seeds give equal data.
std::vector<ThrusterData> simulate_thruster(const ThrusterParameters& parameters,
                                            const ThrusterExperiments& experiments, std::uint32_t seed);

}  // namespace dynlab::inline numerics
