#include "numerics/plants/two_tanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "numerics/error.h"

namespace test_two_tanks {

using namespace dynlab;

double mean_square(const Vector& v) {
    return v.squaredNorm() / static_cast<double>(v.size());
}

TEST(two_tanks, empty_as_torricelli_says) {  // oracle: analytic, the root of the level falls linearly
    const TwoTanksParameters p;
    const Matrix levels = two_tanks_levels(p, Vector::Zero(20), 4, {16, 0});
    for (Index k = 0; k < 20; ++k) {
        const double left = std::max(0., 4 - p.k1 * 4 * static_cast<double>(k) / 2);
        EXPECT_NEAR(levels(k, 0), left * left, 1e-7) << k;
    }
    EXPECT_NEAR(levels(19, 0), 0.04, 1e-7) << "nearly empty";
}

TEST(two_tanks, stay_empty_once_empty) {  // oracle: definition
    const Matrix levels = two_tanks_levels({}, Vector::Zero(200), 4, {5, 5});
    EXPECT_LT(levels.bottomRows(20).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(two_tanks, rest_where_their_flows_balance) {  // oracle: residuals of both equations
    const TwoTanksParameters p;
    for (double voltage : {1., 2., 3.}) {
        const TwoTanksTruth truth = two_tanks_truth(p, voltage);
        EXPECT_NEAR(p.k4 * voltage - p.k1 * std::sqrt(truth.upper_level), 0, 1e-12);
        EXPECT_NEAR(p.k2 * std::sqrt(truth.upper_level) - p.k3 * std::sqrt(truth.lower_level), 0, 1e-12);
        const Matrix levels = two_tanks_levels(p, Vector::Constant(600, voltage), 4, {8, 3});
        EXPECT_NEAR(levels(599, 0), truth.upper_level, 1e-6);
        EXPECT_NEAR(levels(599, 1), truth.lower_level, 1e-6);
        EXPECT_DOUBLE_EQ(truth.output, 0.3 + 0.5 * truth.lower_level);
    }
}

// oracle: the step response of two lags in a row, for a step so small that the tanks are linear
TEST(two_tanks, small_changes_have_the_gain_and_the_documented_time_constants) {
    const TwoTanksParameters p;
    const double at = 2.5, step = 1e-4;
    const TwoTanksTruth truth = two_tanks_truth(p, at);
    const Matrix levels =
        two_tanks_levels(p, Vector::Constant(150, at + step), 4, {truth.upper_level, truth.lower_level});
    for (Index k = 0; k < 150; ++k) {
        const double t = 4 * static_cast<double>(k), slow = truth.upper, fast = truth.lower;
        const double response = 1 - (slow * std::exp(-t / slow) - fast * std::exp(-t / fast)) / (slow - fast);
        const double change = p.sensor_gain * (levels(k, 1) - truth.lower_level) / (truth.gain * step);
        EXPECT_NEAR(change, response, 2e-4) << k;
    }
}

TEST(two_tanks, run_over_their_rims) {  // oracle: statics of a full upper tank
    TwoTanksParameters p;
    p.overflow_part = 0.2;
    p.k2 = 0.07;
    const double voltage = 5, over = p.k4 * voltage - p.k1 * std::sqrt(p.height);
    ASSERT_GT(over, 0);
    Matrix levels = two_tanks_levels(p, Vector::Constant(800, voltage), 4, {5, 5});
    EXPECT_EQ(levels.col(0).maxCoeff(), p.height);
    const double lower = std::pow((p.k2 * std::sqrt(p.height) + p.overflow_part * over) / p.k3, 2);
    ASSERT_LT(lower, p.height);
    EXPECT_NEAR(levels(799, 1), lower, 1e-6);
    p.overflow_part = 1;
    p.k2 = 0.102;
    levels = two_tanks_levels(p, Vector::Constant(800, voltage), 4, {5, 5});
    EXPECT_EQ(levels(799, 1), p.height) << "both are full";
    // Then the pump stops: the upper tank leaves its rim at once, and the lower one when it gets less than it gives.
    Vector stops = Vector::Constant(820, voltage);
    stops.tail(20).setZero();
    levels = two_tanks_levels(p, stops, 4, {5, 5});
    EXPECT_LT(levels(801, 0), p.height);
    EXPECT_NEAR(levels(805, 0), std::pow(std::sqrt(p.height) - p.k1 * 20 / 2, 2), 1e-7);
    EXPECT_LT(levels(805, 1), p.height);
}

// oracle: a second route, Heun's method in steps of a hundredth of a second that stops at the rims
TEST(two_tanks, follow_their_equations_over_a_whole_record) {
    const TwoTanksParameters p;
    const TwoTanksData data_sets = simulate_two_tanks(p, {}, 3);
    const TwoTanksTruth start = two_tanks_truth(p, TwoTanksExperiments().start_voltage);
    const Matrix levels = two_tanks_levels(p, data_sets.estimation.u, 4, {start.upper_level, start.lower_level});
    double h1 = start.upper_level, h2 = start.lower_level, worst = 0, full = 0;
    const double step = 0.01;
    for (Index k = 0; k < levels.rows(); ++k) {
        worst = std::max({worst, std::abs(h1 - levels(k, 0)), std::abs(h2 - levels(k, 1))});
        full += levels(k, 0) == p.height ? 1 : 0;
        const double inflow = p.k4 * data_sets.estimation.u[k];
        const auto rate = [&](double a, double b) {
            const double net = inflow - p.k1 * std::sqrt(std::max(a, 0.));
            const bool over = a >= p.height && net > 0;
            return std::pair(over ? 0 : net, p.k2 * std::sqrt(std::max(a, 0.)) - p.k3 * std::sqrt(std::max(b, 0.)) +
                                                 (over ? p.overflow_part * net : 0));
        };
        for (int i = 0; i < 400; ++i) {
            const auto [a1, a2] = rate(h1, h2);
            const auto [b1, b2] = rate(std::min(h1 + step * a1, p.height), std::min(h2 + step * a2, p.height));
            h1 = std::clamp(h1 + step / 2 * (a1 + b1), 0., p.height);
            h2 = std::clamp(h2 + step / 2 * (a2 + b2), 0., p.height);
        }
    }
    EXPECT_LT(worst, 5e-3);
    EXPECT_GT(full, 20) << "the record runs over, or the test says nothing of it";
}

TEST(two_tanks, voltage_is_a_multisine) {  // oracle: definition of the discrete Fourier transform
    TwoTanksExperiments plan;
    plan.voltage_std = 0.3;  // nothing is limited
    const Vector u = simulate_two_tanks({}, plan, 1).validation.u;
    EXPECT_NEAR(u.mean(), plan.mean_voltage, 1e-12);
    EXPECT_NEAR(std::sqrt(mean_square(u.array() - u.mean())), plan.voltage_std, 1e-12);
    const auto amplitude = [&](int line) {
        std::complex<double> sum = 0;
        for (Index k = 0; k < u.size(); ++k)
            sum += u[k] * std::polar(1., -2 * M_PI * line * static_cast<double>(k) / static_cast<double>(u.size()));
        return 2 * std::abs(sum) / static_cast<double>(u.size());
    };
    for (int line : {1, 7, 59}) EXPECT_NEAR(amplitude(line), plan.voltage_std * std::sqrt(2. / 59), 1e-12) << line;
    for (int line : {60, 100, 512}) EXPECT_NEAR(amplitude(line), 0, 1e-12) << line;
    const Vector limited = simulate_two_tanks({}, {}, 1).estimation.u;
    EXPECT_EQ(limited.minCoeff(), 0);
    EXPECT_EQ(limited.maxCoeff(), TwoTanksExperiments().greatest_voltage);
}

TEST(two_tanks, sensor_is_as_stated) {  // oracle: statistics with fixed seed, and rounding
    const TwoTanksParameters p;
    const TwoTanksData data_sets = simulate_two_tanks(p, {}, 5);
    const TwoTanksTruth start = two_tanks_truth(p, TwoTanksExperiments().start_voltage);
    const Matrix levels = two_tanks_levels(p, data_sets.validation.u, 4, {start.upper_level, start.lower_level});
    const Vector noise = data_sets.validation.y.array() - p.sensor_offset - p.sensor_gain * levels.col(1).array();
    const double expected = std::hypot(p.noise_std, p.resolution / std::sqrt(12.));
    EXPECT_NEAR(std::sqrt(mean_square(noise)), expected, 4 * expected / std::sqrt(2. * 1024));
    for (double value : data_sets.validation.y) EXPECT_NEAR(value / 0.01, std::round(value / 0.01), 1e-7);
}

TEST(two_tanks, equal_seeds_give_equal_records) {
    const TwoTanksData one = simulate_two_tanks({}, {}, 2), again = simulate_two_tanks({}, {}, 2);
    EXPECT_EQ(one.estimation.y, again.estimation.y);
    EXPECT_EQ(one.validation.y, again.validation.y);
    EXPECT_NE(one.estimation.u, one.validation.u);
    EXPECT_NE(one.estimation.u, simulate_two_tanks({}, {}, 3).estimation.u);
}

TEST(two_tanks, refuse_what_is_not_physical) {
    TwoTanksParameters p;
    p.overflow_part = 1.1;
    EXPECT_THROW(two_tanks_truth(p, 2), InvalidArgument);
    EXPECT_THROW(two_tanks_truth({}, 5), InvalidArgument) << "runs over";
    EXPECT_THROW(two_tanks_levels({}, Vector::Constant(3, -1.), 4, {1, 1}), InvalidArgument);
    EXPECT_THROW(two_tanks_levels({}, Vector(), 4, {1, 1}), InvalidArgument);
    EXPECT_THROW(two_tanks_levels({}, Vector::Ones(3), 4, {21, 1}), InvalidArgument);
    TwoTanksExperiments plan;
    plan.lines = 512;
    EXPECT_THROW(simulate_two_tanks({}, plan, 1), InvalidArgument);
}

}  // namespace test_two_tanks
