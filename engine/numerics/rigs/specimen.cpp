#include "numerics/rigs/specimen.h"

#include "numerics/signals/random.h"

namespace dynlab::inline numerics {
namespace {

/// Changes parameters one after the other; none of specimen 0.
class Variation {
  public:
    explicit Variation(std::uint32_t number) : random_(number), varies_(number > 0) {}
    void change(double& parameter, double spread) {
        if (varies_) parameter *= 1 + spread * (2 * random_.uniform() - 1);
    }

  private:
    RandomStream random_;
    bool varies_;
};

}  // namespace

CraneParameters crane_specimen(std::uint32_t number) {
    CraneParameters p;
    Variation variation(number);
    variation.change(p.pendulum_length, 0.15);
    variation.change(p.pendulum_mass, 0.15);
    variation.change(p.pivot_damping, 0.2);
    variation.change(p.trolley_mass, 0.1);
    variation.change(p.motor_damping, 0.1);
    variation.change(p.coulomb_friction, 0.1);
    return p;
}

DriftingProcessParameters drifting_process_specimen(std::uint32_t number) {
    DriftingProcessParameters p;
    Variation variation(number);
    variation.change(p.clean_gain, 0.2);
    variation.change(p.clean_time_constant, 0.2);
    variation.change(p.lost_gain, 0.1);
    variation.change(p.more_time, 0.15);
    variation.change(p.growth_time, 0.2);
    variation.change(p.cleaning_time, 0.15);
    return p;
}

DriveParameters drive_specimen(std::uint32_t number) {
    DriveParameters p;
    Variation variation(number);
    variation.change(p.motor_constant, 0.1);
    variation.change(p.inertia, 0.15);
    variation.change(p.inductance, 0.15);
    return p;
}

HeatExchangerParameters heat_exchanger_specimen(std::uint32_t number) {
    HeatExchangerParameters p;
    Variation variation(number);
    variation.change(p.mass, 0.2);
    variation.change(p.flow, 0.15);
    variation.change(p.power, 0.15);
    return p;
}

HeatTransferParameters heat_transfer_specimen(std::uint32_t number) {
    HeatTransferParameters p;
    Variation variation(number);
    variation.change(p.heater_capacity, 0.2);
    variation.change(p.air_capacity, 0.15);
    variation.change(p.power, 0.15);
    variation.change(p.dead_time, 0.15);
    return p;
}

LinearSystemParameters linear_system_specimen(std::uint32_t number) {
    LinearSystemParameters p;
    Variation variation(number);
    variation.change(p.gain, 0.25);
    variation.change(p.zero, 0.15);
    variation.change(p.pole, 0.2);
    variation.change(p.frequency, 0.15);
    variation.change(p.damping, 0.2);
    return p;
}

FirstOrderStepParameters step_response_specimen(std::uint32_t number) {
    FirstOrderStepParameters p;
    Variation variation(number);
    variation.change(p.gain, 0.25);
    variation.change(p.time_constant, 0.25);
    return p;
}

SuspensionParameters suspension_specimen(std::uint32_t number) {
    SuspensionParameters p;
    Variation variation(number);
    variation.change(p.mass, 0.15);
    variation.change(p.stiffness, 0.2);
    variation.change(p.damping, 0.2);
    return p;
}

ThrusterParameters thruster_specimen(std::uint32_t number) {
    ThrusterParameters p;
    Variation variation(number);
    variation.change(p.dead_band, 0.2);
    variation.change(p.delay, 0.2);
    variation.change(p.inertia, 0.15);
    variation.change(p.forward_thrust, 0.08);
    variation.change(p.reverse_thrust, 0.08);
    variation.change(p.cell_frequency, 0.1);
    return p;
}

TwoTanksParameters two_tanks_specimen(std::uint32_t number) {
    TwoTanksParameters p;
    Variation variation(number);
    double upper = 1, lower = 1;  // one over the tanks' areas
    variation.change(upper, 0.15);
    variation.change(lower, 0.15);
    p.k1 *= upper;
    p.k4 *= upper;
    p.k2 *= lower;
    p.k3 *= lower;
    variation.change(p.k4, 0.08);
    variation.change(p.k3, 0.08);
    variation.change(p.overflow_part, 0.2);
    return p;
}

}  // namespace dynlab::inline numerics
