#include "numerics/plants/plant_variant.h"

#include <initializer_list>

#include "numerics/signals/random.h"

namespace dynlab::inline numerics {
namespace {

struct Change {
    double& parameter;
    double spread;
};

/// Changes parameters in sequence; none for variant 0.
void vary(std::uint32_t number, std::initializer_list<Change> changes) {
    if (number == 0) return;
    RandomStream random(number);
    for (const auto& [parameter, spread] : changes) parameter *= 1 + spread * (2 * random.uniform() - 1);
}

}  // namespace

CraneParameters crane_variant(std::uint32_t number) {
    CraneParameters p;
    vary(number, {{p.pendulum_length, 0.15},
                  {p.pendulum_mass, 0.15},
                  {p.pivot_damping, 0.2},
                  {p.trolley_mass, 0.1},
                  {p.motor_damping, 0.1},
                  {p.coulomb_friction, 0.1}});
    return p;
}

DriftingProcessParameters drifting_process_variant(std::uint32_t number) {
    DriftingProcessParameters p;
    vary(number, {{p.clean_gain, 0.2},
                  {p.clean_time_constant, 0.2},
                  {p.lost_gain, 0.1},
                  {p.more_time, 0.15},
                  {p.growth_time, 0.2},
                  {p.cleaning_time, 0.15}});
    return p;
}

DriveParameters drive_variant(std::uint32_t number) {
    DriveParameters p;
    vary(number, {{p.motor_constant, 0.1}, {p.inertia, 0.15}, {p.inductance, 0.15}});
    return p;
}

HeatExchangerParameters heat_exchanger_variant(std::uint32_t number) {
    HeatExchangerParameters p;
    vary(number, {{p.mass, 0.2}, {p.flow, 0.15}, {p.power, 0.15}});
    return p;
}

HeatTransferParameters heat_transfer_variant(std::uint32_t number) {
    HeatTransferParameters p;
    vary(number, {{p.heater_capacity, 0.2}, {p.air_capacity, 0.15}, {p.power, 0.15}, {p.dead_time, 0.15}});
    return p;
}

LinearSystemParameters linear_system_variant(std::uint32_t number) {
    LinearSystemParameters p;
    vary(number, {{p.gain, 0.25}, {p.zero, 0.15}, {p.pole, 0.2}, {p.frequency, 0.15}, {p.damping, 0.2}});
    return p;
}

FirstOrderStepParameters step_response_variant(std::uint32_t number) {
    FirstOrderStepParameters p;
    vary(number, {{p.gain, 0.25}, {p.time_constant, 0.25}});
    return p;
}

SuspensionParameters suspension_variant(std::uint32_t number) {
    SuspensionParameters p;
    vary(number, {{p.mass, 0.15}, {p.stiffness, 0.2}, {p.damping, 0.2}});
    return p;
}

ThrusterParameters thruster_variant(std::uint32_t number) {
    ThrusterParameters p;
    vary(number, {{p.dead_band, 0.2},
                  {p.delay, 0.2},
                  {p.inertia, 0.15},
                  {p.forward_thrust, 0.08},
                  {p.reverse_thrust, 0.08},
                  {p.cell_frequency, 0.1}});
    return p;
}

TwoTanksParameters two_tanks_variant(std::uint32_t number) {
    TwoTanksParameters p;
    double upper = 1, lower = 1;  // one over the tanks' areas
    double pump = 1, outlet = 1;
    vary(number, {{upper, 0.15}, {lower, 0.15}, {pump, 0.08}, {outlet, 0.08}, {p.overflow_part, 0.2}});
    p.k1 *= upper;
    p.k2 *= lower;
    p.k3 = p.k3 * lower * outlet;
    p.k4 = p.k4 * upper * pump;
    return p;
}

}  // namespace dynlab::inline numerics
