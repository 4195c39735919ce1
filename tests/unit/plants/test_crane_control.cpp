// Oracles: the experiments, which drive the same crane without a controller; physics of a held and a braked trolley.
#include "numerics/plants/crane_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_crane_control {

CraneExperiments without_noise() {
    CraneExperiments plan;
    plan.angle_noise_std = plan.angle_resolution = plan.position_resolution = plan.angle_offset = 0;
    return plan;
}

TEST(crane_control, a_controller_that_replays_a_voltage_repeats_the_experiment) {
    const CraneData steps = simulate_crane({}, without_noise(), 3)[2];
    const auto replay = [&](double t, double, double) {
        return steps.u[static_cast<Index>(std::llround(t / without_noise().Ts))];
    };
    const CraneRun run{.duration = steps.t[steps.t.size() - 1], .position = steps.x[0]};
    const CraneData again = control_crane({}, without_noise(), run, replay, 3);
    EXPECT_EQ((again.x - steps.x).norm(), 0);
    EXPECT_EQ((again.theta - steps.theta).norm(), 0);
}

TEST(crane_control, proportional_control_ends_within_what_dry_friction_holds) {
    const double gain = 20, goal = 0.3;
    const auto proportional = [&](double, double x, double) { return gain * (goal - x); };
    const CraneData data_set = control_crane({}, {}, {.duration = 20}, proportional, 1);
    const double held = crane_truth({}).starting_voltage / gain;
    EXPECT_NEAR(data_set.x[data_set.x.size() - 1], goal, held + 1e-3);
}

TEST(crane_control, sensors_round_and_equal_seeds_give_equal_records) {
    const auto off = [](double, double, double) { return 0.; };
    const CraneData first = control_crane({}, {}, {.duration = 2, .angle = 0.2}, off, 5);
    const CraneData same = control_crane({}, {}, {.duration = 2, .angle = 0.2}, off, 5);
    const CraneData other = control_crane({}, {}, {.duration = 2, .angle = 0.2}, off, 6);
    EXPECT_EQ((first.theta - same.theta).norm(), 0);
    EXPECT_GT((first.theta - other.theta).norm(), 0);
    const Vector steps = first.theta / CraneExperiments{}.angle_resolution;
    EXPECT_LT((steps - steps.array().round().matrix()).norm(), 1e-9);
}

TEST(crane_control, refuses_a_start_off_the_rail_and_a_voltage_that_is_none) {
    const auto off = [](double, double, double) { return 0.; };
    const auto broken = [](double t, double, double) { return t > 0.5 ? std::nan("") : 0.; };
    EXPECT_EQ(thrown_message([&] { control_crane({.rail = 0.5}, {}, {.position = 0.6}, off, 1); }),
              "The initial position of the crane must be on the rail, between -0.5 m and 0.5 m");
    EXPECT_THROW(control_crane({}, {}, {.duration = 0}, off, 1), InvalidArgument);
    EXPECT_NE(thrown_message([&] { control_crane({}, {}, {}, broken, 1); }).find("at t = 0.52 s"), std::string::npos);
}

}  // namespace test_crane_control
}  // namespace dynlab
