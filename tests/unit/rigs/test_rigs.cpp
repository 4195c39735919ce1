#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/rigs/first_order_step.h"
#include "numerics/rigs/heat_exchanger.h"
#include "numerics/rigs/suspension.h"
#include "numerics/signals/random.h"

namespace test_rigs {

using namespace dynlab;

TEST(heat_exchanger, obeys_its_energy_balance) {  // oracle: residual of the differential equation
    HeatExchangerParameters p;
    p.noise_std = p.resolution = 0;
    p.Ts = 0.01;
    p.duration = 120;
    const RigRecord record = simulate_heat_exchanger(p, 1);
    const double capacity = p.mass * p.specific_heat + p.wall_capacity;
    for (Index k : {1000, 6100, 9000, 11000}) {
        const double T = record.y[k], rate = (record.y[k + 1] - record.y[k - 1]) / (2 * p.Ts);
        const double heat = p.flow * p.specific_heat * (p.inlet_temperature - T) + p.loss * (p.room_temperature - T) +
                            p.power * record.u[k] / 100;
        EXPECT_NEAR(capacity * rate, heat, 1e-4 * p.power) << k;
    }
}

TEST(heat_exchanger, rests_before_and_after_the_step) {  // oracle: analytic equilibrium
    HeatExchangerParameters p;
    p.noise_std = p.resolution = 0;
    p.duration = 5000;
    const HeatExchangerTruth truth = heat_exchanger_truth(p);
    const RigRecord record = simulate_heat_exchanger(p, 1);
    EXPECT_NEAR(record.y[0], truth.initial_output, 1e-12);
    EXPECT_NEAR(record.y[30], truth.initial_output, 1e-12);
    EXPECT_NEAR(record.y[record.y.size() - 1], truth.final_output, 1e-9);
    EXPECT_NEAR(truth.final_output - truth.initial_output, truth.gain * (p.valve_after - p.valve_before), 1e-12);
    EXPECT_EQ(record.u[29], p.valve_before);
    EXPECT_EQ(record.u[30], p.valve_after);
    EXPECT_GT(truth.initial_output, truth.output_at_zero_input);
}

TEST(heat_exchanger, sensor_rounds_and_adds_the_stated_noise) {  // oracle: statistics, fixed seed
    HeatExchangerParameters p, clean;
    clean.noise_std = clean.resolution = 0;
    p.duration = clean.duration = 8000;
    const Vector noise = simulate_heat_exchanger(p, 3).y - simulate_heat_exchanger(clean, 3).y;
    const double N = static_cast<double>(noise.size());
    EXPECT_NEAR(noise.mean(), 0, 4 * p.noise_std / std::sqrt(N));
    EXPECT_NEAR(std::sqrt(noise.squaredNorm() / N), p.noise_std, 4 * p.noise_std / std::sqrt(2 * N));
    const RigRecord record = simulate_heat_exchanger(p, 3);
    for (double y : record.y) EXPECT_NEAR(y / p.resolution, std::round(y / p.resolution), 1e-6);
}

TEST(heat_exchanger, repeats_for_equal_seeds_only) {  // oracle: definition
    const HeatExchangerParameters p;
    EXPECT_EQ(simulate_heat_exchanger(p, 5).y, simulate_heat_exchanger(p, 5).y);
    EXPECT_NE(simulate_heat_exchanger(p, 5).y, simulate_heat_exchanger(p, 6).y);
}

TEST(heat_exchanger, refuses_unphysical_values) {
    HeatExchangerParameters p;
    p.mass = -1;
    EXPECT_THROW(simulate_heat_exchanger(p, 1), InvalidArgument);
    p = {};
    p.valve_after = 120;
    EXPECT_THROW(simulate_heat_exchanger(p, 1), InvalidArgument);
    p = {};
    p.step_time = p.duration;
    EXPECT_THROW(simulate_heat_exchanger(p, 1), InvalidArgument);
}

TEST(suspension, obeys_newtons_law) {  // oracle: residual of the differential equation
    SuspensionParameters p;
    p.noise_std = p.resolution = 0;
    p.Ts = 1e-4;
    p.step_time = 0.5;
    const RigRecord record = simulate_suspension(p, 1);
    for (Index k : {100, 5100, 9000, 20000}) {
        const double h = p.Ts, x = 1e-3 * record.y[k];
        const double rate = 1e-3 * (record.y[k + 1] - record.y[k - 1]) / (2 * h);
        const double acceleration = 1e-3 * (record.y[k + 1] - 2 * record.y[k] + record.y[k - 1]) / (h * h);
        EXPECT_NEAR(p.mass * acceleration + p.damping * rate + p.stiffness * x, p.force_per_volt * record.u[k], 2e-4)
            << k;
    }
}

TEST(suspension, peaks_where_the_truth_says) {  // oracle: analytic
    SuspensionParameters p;
    p.noise_std = p.resolution = 0;
    p.Ts = 1e-4;
    const SuspensionTruth truth = suspension_truth(p);
    const RigRecord record = simulate_suspension(p, 1);
    Index top = 0;
    const double peak = record.y.maxCoeff(&top);
    EXPECT_NEAR(record.t[top], truth.overshoot_time, p.Ts);
    EXPECT_NEAR(peak, truth.gain * (1 + truth.overshoot), 1e-6);
    EXPECT_EQ(record.y[0], 0);
    EXPECT_EQ(record.u.minCoeff(), 1);
}

TEST(suspension, refuses_unphysical_values) {
    SuspensionParameters p;
    p.damping = 400;
    EXPECT_THROW(simulate_suspension(p, 1), InvalidArgument);
    p = {};
    p.stiffness = 0;
    EXPECT_THROW(simulate_suspension(p, 1), InvalidArgument);
    p = {};
    p.step_height = 0;
    EXPECT_THROW(simulate_suspension(p, 1), InvalidArgument);
}

TEST(first_order_step, satisfies_both_descriptions) {  // oracle: definition of the two models
    const FirstOrderStepParameters p;
    const FirstOrderStepTruth truth = first_order_step_truth(p);
    const FirstOrderStepRecord record = simulate_first_order_step(p, 1);
    ASSERT_EQ(record.t.size(), 4);
    for (Index k = 0; k < 4; ++k) EXPECT_NEAR(record.ydot[k], truth.a * record.y[k] + truth.b * record.u[k], 1e-14);
    for (Index k = 0; k < 3; ++k) EXPECT_NEAR(record.y[k + 1], truth.f * record.y[k] + truth.g * record.u[k], 1e-14);
}

TEST(first_order_step, noise_is_the_normal_stream) {  // oracle: definition
    const FirstOrderStepParameters p;
    const FirstOrderStepRecord record = simulate_first_order_step(p, 7);
    RandomStream random(7);
    const Vector first = random.normal(4), second = random.normal(4);
    EXPECT_LT((record.y_noisy - record.y - p.output_noise_std * first).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((record.ydot_noisy - record.ydot - p.derivative_noise_std * second).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(first_order_step, refuses_what_is_no_experiment) {
    FirstOrderStepParameters p;
    p.samples = 1;
    EXPECT_THROW(simulate_first_order_step(p, 1), InvalidArgument);
    p = {};
    p.time_constant = 0;
    EXPECT_THROW(simulate_first_order_step(p, 1), InvalidArgument);
}

}  // namespace test_rigs
