#include "numerics/plants/drive.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "numerics/error.h"
#include "numerics/plants/plant_variant.h"
#include "numerics/simulation/lsim.h"

namespace test_drive {

using namespace dynlab;

DriveParameters exact() {
    DriveParameters p;
    p.load_std = p.noise_std = p.resolution = 0;
    return p;
}

double rms(const Vector& v) {
    return std::sqrt(v.squaredNorm() / static_cast<double>(v.size()));
}

TEST(drive, open_loop_is_the_plant_s_response) {  // oracle: simulation of the transfer function
    const DriveParameters p = exact();
    RandomStream random(1);
    const Vector u = random.normal(500);
    const DriveData data_set = simulate_open_drive(p, u, random);
    EXPECT_LT((data_set.y - lsim(drive_plant(p), u, p.Ts)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(data_set.u, u);
    EXPECT_EQ(data_set.r, Vector::Zero(500));
}

TEST(drive, settles_where_torques_and_voltages_balance) {  // oracle: statics
    const DriveParameters p = exact();
    RandomStream random(1);
    const Vector speed = simulate_open_drive(p, Vector::Constant(800, 2.), random).y;
    const double current = (2 - p.motor_constant * speed[799]) / p.resistance;
    EXPECT_NEAR(p.motor_constant * current, p.friction * speed[799], 1e-9);
    EXPECT_NEAR(drive_plant(p).dc_gain(), speed[799] / 2, 1e-9);
    EXPECT_NEAR(drive_load(p).dc_gain(), -p.resistance / (p.resistance * p.friction + std::pow(p.motor_constant, 2)),
                1e-9);
}

// oracle: the controller's law, applied to what was recorded
TEST(drive, voltage_follows_from_the_errors_before) {
    const DriveParameters p;
    RandomStream random(4);
    const DriveData data_set = simulate_drive(p, 8 * random.normal(300), random);
    const TransferFunction C = drive_controller(p);
    EXPECT_EQ(data_set.u[0], 0);
    double sum = 0;
    for (Index k = 1; k < 300; ++k) {
        const double error = data_set.r[k - 1] - data_set.y[k - 1];
        sum += error;
        EXPECT_NEAR(data_set.u[k], p.gain * error + p.integral_gain * p.Ts * sum, 1e-12) << k;
    }
    EXPECT_LT((data_set.u - lsim(C, data_set.r - data_set.y, p.Ts)).cwiseAbs().maxCoeff(), 1e-9)
        << "its transfer function";
}

TEST(drive, brings_the_speed_to_the_reference) {  // oracle: integral action
    RandomStream random(1);
    const DriveData data_set = simulate_drive(exact(), Vector::Constant(1000, 5.), random);
    EXPECT_NEAR(data_set.y[999], 5, 1e-4);
    for (std::uint32_t number = 1; number <= 50; ++number) {
        DriveParameters p = drive_variant(number);
        p.load_std = p.noise_std = p.resolution = 0;
        EXPECT_NEAR(simulate_drive(p, Vector::Constant(1500, 5.), random).y[1499], 5, 1e-3) << number;
    }
}

// oracle: the Lyapunov equation of current, speed and torque, solved as one linear system
TEST(drive, load_disturbs_as_stated) {
    DriveParameters p = exact();
    p.load_std = 0.03;
    Eigen::Matrix3d A;
    A << -p.resistance / p.inductance, -p.motor_constant / p.inductance, 0, p.motor_constant / p.inertia,
        -p.friction / p.inertia, -1 / p.inertia, 0, 0, -1 / p.load_time;
    Eigen::Matrix<double, 9, 9> lyapunov = Eigen::Matrix<double, 9, 9>::Zero();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) {
                lyapunov(3 * i + j, 3 * k + j) += A(i, k);
                lyapunov(3 * i + j, 3 * i + k) += A(j, k);
            }
    Eigen::Matrix<double, 9, 1> driven = Eigen::Matrix<double, 9, 1>::Zero();
    driven[8] = -2 * p.load_std * p.load_std / p.load_time;
    const double variance = lyapunov.partialPivLu().solve(driven)[4];
    RandomStream random(2);
    const Vector speed = simulate_open_drive(p, Vector::Zero(400000), random).y;
    EXPECT_NEAR(rms(speed), std::sqrt(variance), 0.03 * std::sqrt(variance));
}

TEST(drive, tachometer_is_as_stated) {  // oracle: statistics with fixed seed, and rounding
    DriveParameters p = exact();
    p.noise_std = 0.4;
    p.resolution = 0.05;
    RandomStream random(3);
    const Vector reading = simulate_open_drive(p, Vector::Zero(100000), random).y;
    EXPECT_NEAR(rms(reading), std::hypot(0.4, 0.05 / std::sqrt(12.)), 0.004);
    for (double value : reading.head(100)) EXPECT_NEAR(value / 0.05, std::round(value / 0.05), 1e-9);
}

TEST(drive, has_four_experiments) {  // oracle: definition
    const auto one = simulate_drive({}, {}, 3), again = simulate_drive({}, {}, 3), other = simulate_drive({}, {}, 4);
    ASSERT_EQ(one.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(one[i].y, again[i].y);
        EXPECT_NE(one[i].y, other[i].y);
        EXPECT_EQ(one[i].y.size(), 5100);
    }
    EXPECT_EQ(one[0].r.cwiseAbs(), Vector::Constant(5100, 8.));
    EXPECT_NE(one[0].r, one[1].r);
    EXPECT_EQ(one[2].r, Vector::Zero(5100));
    EXPECT_EQ(one[3].u.cwiseAbs(), Vector::Constant(5100, 1.2));
}

TEST(drive, refuses_what_is_not_physical) {
    DriveParameters p;
    p.inductance = 0;
    EXPECT_THROW(drive_plant(p), InvalidArgument);
    RandomStream random(1);
    EXPECT_THROW(simulate_drive(p, Vector::Ones(3), random), InvalidArgument);
    EXPECT_THROW(simulate_open_drive({}, Vector(), random), InvalidArgument);
    EXPECT_THROW(simulate_drive({}, {.reference = 0}, 1), InvalidArgument);
}

}  // namespace test_drive
