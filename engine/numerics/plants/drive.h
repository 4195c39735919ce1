#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "numerics/models/transfer_function.h"
#include "numerics/plants/plant_data.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

/// A direct-current drive whose speed is controlled. With w the speed (rad/s), i the current, u the voltage, m the
/// load's torque:
///     inductance di/dt = u - resistance i - motor_constant w
///     inertia dw/dt = motor_constant i - friction w - m
/// m is first-order Gauss-Markov noise, held between samples as u is. The tachometer's y is w, noisy and rounded. A
/// computer sets the voltage from the error e = r - y of the sample before, since it needs that time for computing:
///     u_k = gain e_(k-1) + integral_gain Ts (e_1 + ... + e_(k-1)).
struct DriveParameters {
    double resistance = 2;        ///< ohm
    double inductance = 0.15;     ///< H
    double motor_constant = 0.1;  ///< N m/A, and V s/rad
    double inertia = 2e-3;        ///< kg m^2
    double friction = 1e-3;       ///< N m s
    double load_std = 0.02;       ///< standard deviation of the load's torque, N m
    double load_time = 0.3;       ///< its correlation time, s
    double noise_std = 0.4;       ///< of the tachometer, rad/s
    double resolution = 0.05;     ///< of its reading, rad/s; 0 for none
    double gain = 0.12;           ///< of the controller, V s/rad
    double integral_gain = 0.6;   ///< V/rad
    double Ts = 0.01;             ///< s

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// From voltage to speed, and from the load's torque to speed (negative).
TransferFunction drive_plant(const DriveParameters& parameters);
TransferFunction drive_load(const DriveParameters& parameters);
/// From the error r - y to the voltage, in discrete time, its sample of computing delay included.
TransferFunction drive_controller(const DriveParameters& parameters);

/// A pseudo-random binary reference, or voltage with the loop open.
struct DriveExperiments {
    int prbs_stages = 8;   ///< 255 bits
    int prbs_hold = 20;    ///< samples per bit
    double reference = 8;  ///< amplitude of the reference, rad/s
    double voltage = 1.2;  ///< amplitude of the voltage with the loop open, V

    /// Throws InvalidArgument naming the first value that is not physical.
    void validate() const;
};

/// Instants (s), reference and reading (rad/s), voltage (V), N values each.
struct DriveData {
    std::string name;
    Vector t, r, u, y;
};

/// The loop with a given reference, from rest; draws the load, then the tachometer's noise.
DriveData simulate_drive(const DriveParameters& parameters, const Vector& reference, RandomStream& random);
/// The same with the loop open and a given voltage; the returned reference is zero.
DriveData simulate_open_drive(const DriveParameters& parameters, const Vector& voltage, RandomStream& random);

/// tracking and validation: the loop with two orders of bits; regulation: the reference rests at zero; open_loop: the
/// voltage is given, without feedback. Equal seeds give equal data.
std::vector<DriveData> simulate_drive(const DriveParameters& parameters, const DriveExperiments& experiments,
                                      std::uint32_t seed);

}  // namespace dynlab::inline numerics
