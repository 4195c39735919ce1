#include "numerics/plants/crane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/plants/crane_experiments.h"

namespace test_crane {

using namespace dynlab;

constexpr OdeOptions kStrict{.relative_tolerance = 1e-12, .absolute_tolerance = 1e-14};

/// No motor torque, nothing that takes energy.
CraneParameters lossless() {
    CraneParameters p;
    p.torque_constant = p.motor_damping = p.belt_damping = p.trolley_damping = 0;
    p.coulomb_friction = p.static_friction = p.pivot_damping = p.air_drag = p.buffer_damping = 0;
    return p;
}

CraneParameters without_dry_friction() {
    CraneParameters p;
    p.coulomb_friction = p.static_friction = 0;
    return p;
}

CraneState at(double position, double angle) {
    CraneState state;
    state.motor_position = state.position = position;
    state.angle = angle;
    return state;
}

/// Of rotor, belt, trolley and pendulum, whose center of mass moves in the plane; zero hanging at rest, J.
double crane_energy(const CraneParameters& p, const CraneState& s) {
    const double rotor_speed = s.motor_speed * p.gear_ratio / p.pulley_radius, l = p.pendulum_length;
    const double across = s.speed + l * std::cos(s.angle) * s.angle_rate,
                 upwards = l * std::sin(s.angle) * s.angle_rate;
    const double height = 2 * l * std::pow(std::sin(s.angle / 2), 2);
    return p.rotor_inertia * rotor_speed * rotor_speed / 2 +
           p.belt_stiffness * std::pow(s.motor_position - s.position, 2) / 2 + p.trolley_mass * s.speed * s.speed / 2 +
           p.pendulum_mass * (across * across + upwards * upwards) / 2 +
           p.pendulum_inertia * s.angle_rate * s.angle_rate / 2 + p.pendulum_mass * p.gravity * height;
}

/// Rate at which energy turns into heat, W.
double heating(const CraneParameters& p, const CraneState& s) {
    const double slip = s.motor_speed - s.speed, swing = std::abs(s.angle_rate), speed = std::abs(s.speed);
    const double surplus = p.static_friction - p.coulomb_friction;
    const double dry = p.coulomb_friction + surplus * std::exp(-std::pow(speed / p.stribeck_speed, 2));
    return p.motor_damping * s.motor_speed * s.motor_speed + p.belt_damping * slip * slip +
           (p.trolley_damping * speed + dry) * speed + (p.pivot_damping + p.air_drag * swing) * swing * swing;
}

TEST(crane, keeps_its_energy_without_friction) {  // oracle: conservation of energy
    const CraneParameters p = lossless();
    CraneState start = at(0, 2.0);
    start.motor_position = 2e-3;
    CraneSimulator crane(p, start, kStrict);
    const double energy = crane_energy(p, start);
    double swing = 0;
    for (int k = 0; k < 1000; ++k) {
        crane.advance(0, 0.01);
        EXPECT_NEAR(crane_energy(p, crane.state()), energy, 1e-9 * energy);
        swing = std::max(swing, std::abs(crane.state().position));
    }
    EXPECT_GT(swing, 0.02);
}

TEST(crane, elastic_buffers_give_back_what_they_take) {  // oracle: conservation of energy
    CraneParameters p = lossless();
    p.rail = 0.05;
    CraneState start = at(0, 0);
    start.speed = start.motor_speed = 0.3;
    CraneSimulator crane(p, start, kStrict);
    const double energy = crane_energy(p, start);
    int contacts = 0;
    bool touching = false;
    for (int k = 0; k < 5000; ++k) {
        crane.advance(0, 1e-3);
        const bool beyond = std::abs(crane.state().position) > p.rail;
        contacts += beyond && !touching;
        touching = beyond;
        if (beyond) continue;
        EXPECT_NEAR(crane_energy(p, crane.state()), energy, 1e-9 * energy);
    }
    EXPECT_GT(contacts, 5);
}

TEST(crane, loses_what_friction_heats) {  // oracle: first law, the heat by Simpson's rule
    CraneParameters p;
    p.torque_constant = 0;
    p.belt_stiffness = 2000;  // slow enough for the rule
    CraneState start = at(0, 1.0);
    start.speed = start.motor_speed = 0.5;
    CraneSimulator crane(p, start, kStrict);
    double heat = 0;
    for (int k = 0; k < 2000; ++k) {
        constexpr double h = 1e-4;
        const double first = heating(p, crane.state());
        crane.advance(0, h / 2);
        const double middle = heating(p, crane.state());
        crane.advance(0, h / 2);
        heat += h / 6 * (first + 4 * middle + heating(p, crane.state()));
        EXPECT_NEAR(crane_energy(p, start) - crane_energy(p, crane.state()), heat, 1e-7);
    }
    EXPECT_GT(heat, 0.1);
}

TEST(crane, buffers_never_pull) {  // oracle: Newton's first law, a trolley that leaves faster than the rubber
    CraneParameters p;
    p.torque_constant = p.trolley_damping = p.coulomb_friction = p.static_friction = 0;
    p.belt_stiffness = 1e-9;
    p.belt_damping = 0;
    p.pendulum_mass = 1e-9;
    p.buffer_damping = 5;  // would pull on whatever leaves faster than 0.2 m/s
    CraneState start = at(p.rail + 0.01, 0);
    start.speed = -1;
    CraneSimulator crane(p, start, kStrict);
    for (int k = 0; k < 200; ++k) {
        crane.advance(0, 1e-4);
        EXPECT_NEAR(crane.state().speed, start.speed, 1e-9);
    }
    EXPECT_LT(crane.state().position, p.rail);
}

TEST(crane, loses_energy_with_friction_and_damped_buffers) {  // oracle: second law
    CraneParameters p;
    p.torque_constant = 0;
    p.rail = 0.02;
    CraneState start = at(0, 1.0);
    start.speed = start.motor_speed = 0.5;
    CraneSimulator crane(p, start);
    double energy = crane_energy(p, start) + 1e-12;
    for (int k = 0; k < 4000; ++k) {
        crane.advance(0, 1e-3);
        const CraneState now = crane.state();
        if (std::abs(now.position) > p.rail) continue;
        EXPECT_LE(crane_energy(p, now), energy);
        energy = crane_energy(p, now) + 1e-12;
    }
}

TEST(crane, small_swings_have_the_stated_frequency) {  // oracle: analytic, held by stiction
    CraneParameters p;
    p.air_drag = 0;
    CraneSimulator crane(p, at(0, 0.001));
    const CraneTruth truth = crane_truth(p);
    const double wn = truth.natural_frequency, z = truth.damping_ratio, wd = wn * std::sqrt(1 - z * z);
    for (int k = 1; k <= 1000; ++k) {
        crane.advance(0, 0.01);
        const double t = 0.01 * k, envelope = std::exp(-z * wn * t);
        const double exact = 0.001 * envelope * (std::cos(wd * t) + z * wn / wd * std::sin(wd * t));
        EXPECT_NEAR(crane.state().angle, exact, 1e-8);
    }
    EXPECT_TRUE(crane.sticks());
    EXPECT_EQ(crane.state().position, 0);
}

TEST(crane, large_swings_take_longer) {  // oracle: analytic, period by the arithmetic-geometric mean
    CraneParameters p;
    p.pivot_damping = p.air_drag = 0;
    p.static_friction = p.coulomb_friction = 1e3;  // holds the trolley
    const double angle = 2;
    CraneSimulator crane(p, at(0, angle));
    double a = 1, b = std::cos(angle / 2);
    for (int k = 0; k < 20; ++k) {
        const double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    crane.advance(0, 2 * M_PI / crane_truth(p).natural_frequency / a);
    EXPECT_NEAR(crane.state().angle, angle, 1e-8);
    EXPECT_NEAR(crane.state().angle_rate, 0, 1e-7);
}

TEST(crane, reaches_the_stated_speed) {  // oracle: analytic steady state
    CraneParameters p;
    p.rail = 100;
    p.pivot_damping = 0.1;  // no swing is left after 20 s
    const CraneTruth truth = crane_truth(p);
    for (double volts : {2.0, -3.0, 40.0}) {
        CraneSimulator crane(p);
        crane.advance(volts, 20);
        const double limited = std::min(std::abs(volts), p.voltage_limit);
        const double speed = truth.speed_gain * (limited - truth.dry_voltage);
        EXPECT_NEAR(crane.state().speed, std::copysign(speed, volts), 1e-9) << volts;
    }
}

TEST(crane, follows_its_time_constant) {  // oracle: analytic first-order rise, pendulum and belt as good as rigid
    CraneParameters p = without_dry_friction();
    p.inductance = 1e-5;
    p.belt_stiffness = 1e6;
    p.pendulum_mass = 1e-6;
    p.pendulum_inertia = 0;
    const CraneTruth truth = crane_truth(p);
    CraneSimulator crane(p, {}, {.relative_tolerance = 1e-7, .absolute_tolerance = 1e-10});
    crane.advance(2, truth.time_constant);
    EXPECT_NEAR(crane.state().speed / (2 * truth.speed_gain), 1 - std::exp(-1), 2e-3);
}

TEST(crane, sticks_until_the_starting_voltage) {  // oracle: definition of static friction
    const CraneParameters p;
    const CraneTruth truth = crane_truth(p);
    CraneSimulator weak(p);
    for (int k = 0; k < 200; ++k) weak.advance(0.98 * truth.starting_voltage * k / 200, 0.02);  // without a jerk
    EXPECT_TRUE(weak.sticks());
    EXPECT_EQ(weak.state().position, 0);
    weak.advance(1.5 * truth.starting_voltage, 1);
    EXPECT_GT(weak.state().position, 1e-3);
    weak.advance(0, 20);
    EXPECT_TRUE(weak.sticks());
}

TEST(crane, stays_between_its_buffers) {  // oracle: static compression under the motor's force
    const CraneParameters p;
    CraneSimulator crane(p);
    crane.advance(10, 30);
    const double force = p.torque_constant * p.gear_ratio / p.pulley_radius * 10 / p.resistance;
    EXPECT_NEAR(crane.state().position, p.rail + force / p.buffer_stiffness,
                p.static_friction / p.buffer_stiffness + 1e-9);
    EXPECT_TRUE(crane.sticks());
}

TEST(crane, does_not_depend_on_the_tolerance) {  // oracle: second run with a thousandth of the tolerance
    const CraneParameters p;
    CraneSimulator usual(p, at(0, 0.1)),
        strict(p, at(0, 0.1), {.relative_tolerance = 1e-13, .absolute_tolerance = 1e-15});
    for (int k = 0; k < 500; ++k) {
        const double volts = (k / 13) % 2 == 0 ? 2 : -2;
        usual.advance(volts, 0.02);
        strict.advance(volts, 0.02);
        ASSERT_NEAR(usual.state().position, strict.state().position, 1e-8);
        ASSERT_NEAR(usual.state().angle, strict.state().angle, 1e-8);
    }
}

TEST(crane, experiments_repeat_for_equal_seeds_only) {  // oracle: definition
    const auto one = simulate_crane({}, {}, 5), again = simulate_crane({}, {}, 5), other = simulate_crane({}, {}, 6);
    ASSERT_EQ(one.size(), 5u);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].x, again[i].x);
        EXPECT_EQ(one[i].theta, again[i].theta);
        EXPECT_NE(one[i].theta, other[i].theta);
    }
    EXPECT_NE(one[0].u, one[1].u);
    EXPECT_NE(one[0].u, other[0].u);
}

TEST(crane, sensors_quantize) {  // oracle: definition
    const CraneExperiments plan;
    for (const CraneData& data_set : simulate_crane({}, plan, 2)) {
        for (double x : data_set.x)
            EXPECT_NEAR(x / plan.position_resolution, std::round(x / plan.position_resolution), 1e-9);
        for (double a : data_set.theta)
            EXPECT_NEAR(a / plan.angle_resolution, std::round(a / plan.angle_resolution), 1e-9);
    }
}

TEST(crane, only_the_limits_are_beyond_what_a_linear_model_can_say) {  // oracle: definition of the experiments
    const CraneParameters p;
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        for (const CraneData& data_set : simulate_crane(p, {}, seed)) {
            const bool limits = data_set.name == "limits";
            EXPECT_EQ(data_set.x.cwiseAbs().maxCoeff() > p.rail, limits) << data_set.name << " of seed " << seed;
            EXPECT_EQ(data_set.u.cwiseAbs().maxCoeff() > p.voltage_limit, limits) << data_set.name;
        }
    }
}

TEST(crane, refuses_what_is_not_physical) {
    CraneParameters p;
    p.static_friction = 0.1;
    EXPECT_THROW(CraneSimulator crane(p), InvalidArgument);
    p = {};
    p.belt_stiffness = -1;
    EXPECT_THROW(crane_truth(p), InvalidArgument);
    CraneExperiments plan;
    plan.Ts = 0;
    EXPECT_THROW(simulate_crane({}, plan, 1), InvalidArgument);
}

}  // namespace test_crane
