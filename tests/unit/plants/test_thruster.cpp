#include "numerics/plants/thruster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "numerics/error.h"

namespace test_thruster {

using namespace dynlab;

constexpr double kGravity = 9.80665;

ThrusterParameters exact() {
    ThrusterParameters p;
    p.wake = p.noise_std = p.resolution = p.tare = 0;
    return p;
}

/// Neutral for `before` samples, then `width`.
Vector step_to(double width, Index before, Index count) {
    Vector pwm = Vector::Constant(count, 1500);
    pwm.tail(count - before).setConstant(width);
    return pwm;
}

TEST(thruster, has_the_makers_performance) {  // oracle: published figures of the T200 at 12 V
    const ThrusterParameters p;
    const ThrusterTruth truth = thruster_truth(p);
    EXPECT_NEAR(truth.forward_thrust, 3.71 * kGravity, 0.02);
    EXPECT_NEAR(truth.reverse_thrust, -2.92 * kGravity, 0.02);
    const double current = (p.supply - p.motor_constant * thruster_speed(p, 1900)) / p.resistance;
    EXPECT_NEAR(current, 17, 1.5);
}

TEST(thruster, steady_speed_balances_the_torques) {  // oracle: residual of the equation of motion
    const ThrusterParameters p;
    for (double width : {1100., 1300., 1474., 1526., 1700., 1900.}) {
        const double n = thruster_speed(p, width);
        const double beyond = (std::abs(width - p.neutral) - p.dead_band) / (p.full_width - p.dead_band);
        const double voltage = std::copysign(p.supply * beyond, width - p.neutral);
        const double torque = p.motor_constant * (voltage - p.motor_constant * n) / p.resistance;
        EXPECT_NEAR(torque, p.drag_torque * n * std::abs(n), 1e-12) << width;
        EXPECT_GT(n * (width - p.neutral), 0);
    }
}

TEST(thruster, settles_at_its_steady_thrust) {  // oracle: statics
    const ThrusterParameters p = exact();
    for (double width : {1200., 1510., 1530., 1850.}) {
        const Vector reading = simulate_thruster(p, Vector::Constant(4000, width), 0.002, 1);
        EXPECT_NEAR(reading[3999], thruster_thrust(p, width), 1e-6) << width;
    }
}

TEST(thruster, rests_within_its_dead_band) {  // oracle: definition
    ThrusterParameters p = exact();
    p.tare = 0.3;
    Vector pwm(6);
    pwm << 1475, 1480, 1500, 1510, 1520, 1525;
    const Vector reading = simulate_thruster(p, pwm.replicate(50, 1), 0.002, 1);
    EXPECT_EQ(reading, Vector::Constant(300, p.tare));
}

TEST(thruster, answers_after_its_delay) {  // oracle: definition, a delay between two samples
    const ThrusterParameters p = exact();
    const double Ts = 0.002;
    const Vector reading = simulate_thruster(p, step_to(1800, 100, 200), Ts, 1);
    const auto first = static_cast<Index>(100 + std::ceil(p.delay / Ts));
    for (Index k = 0; k < 200; ++k) {
        if (k < first)
            EXPECT_EQ(reading[k], 0) << k;
        else
            EXPECT_GT(reading[k], 0) << k;
    }
}

TEST(thruster, speeds_up_with_its_time_constant) {  // oracle: analytic, a motor without drag on a stiff load cell
    ThrusterParameters p = exact();
    p.drag_torque = 1e-15;
    p.cell_frequency = 2000;
    p.cell_damping = 0.7;
    const double Ts = 0.002, speed = thruster_speed(p, 1700), w = 2 * M_PI * p.cell_frequency;
    const double lag = p.delay + 2 * p.cell_damping / w;
    const Vector reading = simulate_thruster(p, Vector::Constant(300, 1700), Ts, 1);
    for (Index k = 20; k < 300; ++k) {
        // Before the first sample the pulses had its width, so that the motor starts at once.
        const double t = static_cast<double>(k) * Ts - (lag - p.delay);
        const double n = speed * (1 - std::exp(-t / thruster_truth(p).slow_time_constant));
        EXPECT_NEAR(reading[k], p.forward_thrust * n * n, 1e-4 * p.forward_thrust * speed * speed) << k;
    }
}

TEST(thruster, small_changes_at_full_width_are_faster) {  // oracle: linearization, slope of a logarithm
    ThrusterParameters p = exact();
    p.cell_frequency = 2000;
    p.cell_damping = 0.7;
    const Vector reading = simulate_thruster(p, Vector::Constant(400, 1900), 0.002, 1);
    const double end = thruster_thrust(p, 1900);
    const double slope = std::log((end - reading[200]) / (end - reading[150])) / (50 * 0.002);
    EXPECT_NEAR(-1 / slope, thruster_truth(p).fast_time_constant, 1e-3 * thruster_truth(p).fast_time_constant);
}

TEST(thruster, load_cell_rings) {  // oracle: analytic step response of a second-order system, thrust at once
    ThrusterParameters p = exact();
    p.inertia = 1e-8;
    p.delay = 0;
    const double Ts = 0.002, w = 2 * M_PI * p.cell_frequency, z = p.cell_damping, wd = w * std::sqrt(1 - z * z);
    const Vector reading = simulate_thruster(p, Vector::Constant(500, 1300), Ts, 1);
    const double thrust = thruster_thrust(p, 1300);
    double peak = 0;
    for (Index k = 0; k < 500; ++k) {
        const double t = static_cast<double>(k) * Ts;
        const double swing = std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t));
        EXPECT_NEAR(reading[k] / thrust, 1 - swing, 3e-3) << k;
        peak = std::max(peak, reading[k] / thrust);
    }
    EXPECT_GT(peak, 1.7);
}

TEST(thruster, noise_and_turbulence_are_as_stated) {  // oracle: statistics with fixed seed
    ThrusterParameters p = exact();
    const Index N = 100000;
    p.noise_std = 0.25;
    p.resolution = 0.02;
    const Vector rest = simulate_thruster(p, Vector::Constant(N, 1500), 0.002, 1);
    EXPECT_NEAR(std::sqrt(rest.squaredNorm() / static_cast<double>(N)), p.noise_std, 0.003);
    for (double value : rest.head(100)) EXPECT_NEAR(value / p.resolution, std::round(value / p.resolution), 1e-9);
    p.noise_std = p.resolution = 0;
    p.wake = 0.03;
    p.cell_frequency = 200;
    p.cell_damping = 0.7;
    const Vector pushed = simulate_thruster(p, Vector::Constant(N, 1800), 0.002, 1).tail(N - 1000);
    const Vector eddy = pushed.array() / thruster_thrust(p, 1800) - 1;
    const auto samples = static_cast<double>(eddy.size());
    EXPECT_NEAR(std::sqrt(eddy.squaredNorm() / samples), p.wake, 0.1 * p.wake);
    const Index lag = 50;  // one correlation time
    const double correlation = eddy.head(eddy.size() - lag).dot(eddy.tail(eddy.size() - lag)) / eddy.squaredNorm();
    EXPECT_NEAR(correlation, std::exp(-1), 0.1);
}

TEST(thruster, records_are_chirps_in_whole_microseconds) {  // oracle: definition
    const ThrusterExperiments plan;
    const auto one = simulate_thruster({}, plan, 3), again = simulate_thruster({}, plan, 3),
               other = simulate_thruster({}, plan, 4);
    ASSERT_EQ(one.size(), 6u);
    EXPECT_EQ(one.front().name, "sine_100");
    EXPECT_EQ(one.back().name, "square_300");
    for (std::size_t i = 0; i < one.size(); ++i) {
        const double amplitude = plan.amplitudes[i % 3];
        EXPECT_EQ(one[i].pwm.maxCoeff(), 1500 + amplitude);
        EXPECT_EQ(one[i].pwm.minCoeff(), 1500 - amplitude);
        EXPECT_EQ(one[i].pwm, one[i].pwm.array().round().matrix());
        EXPECT_EQ(one[i].pwm.head(250), Vector::Constant(250, 1500));
        EXPECT_EQ(one[i].pwm.tail(250), Vector::Constant(250, 1500));
        EXPECT_EQ(one[i].force, again[i].force);
        EXPECT_NE(one[i].force, other[i].force);
        EXPECT_EQ(one[i].pwm, other[i].pwm);
        EXPECT_DOUBLE_EQ(one[i].t[1], plan.Ts);
    }
    EXPECT_NE(one[0].force.head(200), one[1].force.head(200));
}

TEST(thruster, refuses_what_is_not_physical) {
    ThrusterParameters p;
    p.full_width = p.dead_band;
    EXPECT_THROW(thruster_truth(p), InvalidArgument);
    ThrusterExperiments plan;
    plan.amplitudes = {100, -1};
    EXPECT_THROW(simulate_thruster({}, plan, 1), InvalidArgument);
    EXPECT_THROW(simulate_thruster({}, Vector(), 0.002, 1), InvalidArgument);
}

}  // namespace test_thruster
