#include "numerics/plants/drive.h"

#include <cmath>
#include <functional>

#include "numerics/error.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {
namespace {

/// One sampling interval of (current, speed) under (voltage, load), both held.
StepMatrices step_of(const DriveParameters& p) {
    Matrix A(2, 2), B(2, 2);
    A << -p.resistance / p.inductance, -p.motor_constant / p.inductance,  //
        p.motor_constant / p.inertia, -p.friction / p.inertia;
    B << 1 / p.inductance, 0, 0, -1 / p.inertia;
    return exact_step(A, B, p.Ts);
}

Vector load_of(const DriveParameters& p, Index count, RandomStream& random) {
    const double kept = std::exp(-p.Ts / p.load_time), fresh = p.load_std * std::sqrt(1 - kept * kept);
    const Vector normals = random.normal(count);
    Vector load(count);
    double torque = p.load_std * normals[0];
    for (Index k = 0; k < count; ++k) {
        if (k > 0) torque = kept * torque + fresh * normals[k];
        load[k] = torque;
    }
    return load;
}

double reading(const DriveParameters& p, double speed, double normal) {
    const double noisy = speed + p.noise_std * normal;
    return p.resolution > 0 ? p.resolution * std::round(noisy / p.resolution) : noisy;
}

/// Runs the drive from rest; voltage(k, y) is asked at each sample for what is held until the next one.
DriveData run(const DriveParameters& p, const Vector& reference, RandomStream& random,
              const std::function<double(Index k, double y)>& voltage) {
    p.validate();
    const Index N = reference.size();
    if (N == 0 || !reference.allFinite())
        throw InvalidArgument(
            "The reference or voltage of the drive must have at least one sample, and every sample must be finite");
    const Vector load = load_of(p, N, random), normals = random.normal(N);
    const StepMatrices step = step_of(p);
    DriveData data_set;
    data_set.t = Vector::LinSpaced(N, 0, static_cast<double>(N - 1)) * p.Ts;
    data_set.r = reference;
    data_set.u.resize(N);
    data_set.y.resize(N);
    Eigen::Vector2d x = Eigen::Vector2d::Zero();
    for (Index k = 0; k < N; ++k) {
        data_set.y[k] = reading(p, x[1], normals[k]);
        data_set.u[k] = voltage(k, data_set.y[k]);
        x = (step.F * x + step.G * Eigen::Vector2d(data_set.u[k], load[k])).eval();
    }
    return data_set;
}

Vector binary(const DriveExperiments& plan, double amplitude, RandomStream& random) {
    return seeded_prbs(plan.prbs_stages, plan.prbs_hold, -amplitude, amplitude, random);
}

/// Of both transfer functions, 1/(inductance inertia) taken out.
Vector denominator(const DriveParameters& p) {
    const double scale = 1 / (p.inductance * p.inertia);
    return Vector{{1, p.resistance / p.inductance + p.friction / p.inertia,
                   scale * (p.resistance * p.friction + p.motor_constant * p.motor_constant)}};
}

}  // namespace

void DriveParameters::validate() const {
    const char* plant = "drive";
    require_positive(plant, "resistance", resistance, "inductance", inductance, "motor constant", motor_constant,
                     "inertia", inertia, "load's correlation time", load_time, "sampling time", Ts);
    require_not_negative(plant, "friction", friction, "load's standard deviation", load_std, "noise standard deviation",
                         noise_std, "resolution", resolution, "controller's gain", gain, "controller's integral gain",
                         integral_gain);
}

void DriveExperiments::validate() const {
    require_positive("drive", "amplitude of the reference", reference, "amplitude of the voltage", voltage);
}

TransferFunction drive_plant(const DriveParameters& p) {
    p.validate();
    return TransferFunction(Vector{{p.motor_constant / (p.inductance * p.inertia)}}, denominator(p));
}

TransferFunction drive_load(const DriveParameters& p) {
    p.validate();
    return TransferFunction(Vector{{-1 / p.inertia, -p.resistance / (p.inductance * p.inertia)}}, denominator(p));
}

TransferFunction drive_controller(const DriveParameters& p) {
    p.validate();
    return TransferFunction(Vector{{p.gain + p.integral_gain * p.Ts, -p.gain}}, Vector{{1, -1, 0}}, p.Ts);
}

DriveData simulate_drive(const DriveParameters& p, const Vector& reference, RandomStream& random) {
    double sum = 0, next = 0;  // of the errors so far; the voltage that was computed for the next sample
    return run(p, reference, random, [&](Index k, double y) {
        const double now = next, error = reference[k] - y;
        sum += error;
        next = p.gain * error + p.integral_gain * p.Ts * sum;
        return now;
    });
}

DriveData simulate_open_drive(const DriveParameters& p, const Vector& voltage, RandomStream& random) {
    DriveData data_set = run(p, voltage, random, [&](Index k, double) { return voltage[k]; });
    data_set.r.setZero();
    return data_set;
}

std::vector<DriveData> simulate_drive(const DriveParameters& p, const DriveExperiments& plan, std::uint32_t seed) {
    p.validate();
    plan.validate();
    RandomStream random(seed);
    std::vector<DriveData> data_sets;
    for (const char* name : {"tracking", "validation"}) {
        const Vector reference = binary(plan, plan.reference, random);
        data_sets.push_back(simulate_drive(p, reference, random));
        data_sets.back().name = name;
    }
    data_sets.push_back(simulate_drive(p, Vector::Zero(data_sets.front().r.size()), random));
    data_sets.back().name = "regulation";
    const Vector voltage = binary(plan, plan.voltage, random);
    data_sets.push_back(simulate_open_drive(p, voltage, random));
    data_sets.back().name = "open_loop";
    return data_sets;
}

}  // namespace dynlab::inline numerics
