#include "numerics/plants/heat_transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "numerics/error.h"

namespace test_heat_transfer {

using namespace dynlab;

HeatTransferParameters exact() {
    HeatTransferParameters p;
    p.drift = p.noise_std = p.resolution = 0;
    return p;
}

Vector response(const HeatTransferParameters& p, const Vector& u, double Ts, std::uint32_t seed = 1) {
    RandomStream random(seed);
    return simulate_heat_transfer(p, u, Ts, random);
}

/// Unit step response of three lags in a row, by partial fractions; a, b, c are their different time constants.
double three_lags(double a, double b, double c, double t) {
    if (t <= 0) return 0;
    const auto term = [t](double own, double first, double second) {
        return own * own / ((own - first) * (own - second)) * std::exp(-t / own);
    };
    return 1 - term(a, b, c) - term(b, a, c) - term(c, a, b);
}

TEST(heat_transfer, steps_as_three_lags_and_a_dead_time) {  // oracle: analytic, linear in the heating power
    const HeatTransferParameters p = exact();
    for (const double Ts : {1.0, 0.7}) {
        constexpr Index kBefore = 20;
        Vector u = Vector::Constant(400, 4);
        u.tail(400 - kBefore).setConstant(6.5);
        const HeatTransferTruth before = heat_transfer_truth(p, 4), after = heat_transfer_truth(p, 6.5);
        const Vector y = response(p, u, Ts);
        for (Index k = 0; k < u.size(); ++k) {
            const double t = static_cast<double>(k - kBefore) * Ts - p.dead_time;
            const double part = three_lags(before.slow, before.fast, p.sensor_time, t);
            EXPECT_NEAR(y[k], before.temperature + (after.temperature - before.temperature) * part, 1e-7) << k;
        }
    }
}

TEST(heat_transfer, gain_is_the_slope_of_the_static_curve) {  // oracle: difference quotient
    const HeatTransferParameters p;
    for (const double voltage : {2.0, 4.0, 7.0}) {
        constexpr double h = 1e-3;
        const double rise =
            heat_transfer_truth(p, voltage + h).temperature - heat_transfer_truth(p, voltage - h).temperature;
        EXPECT_NEAR(heat_transfer_truth(p, voltage).gain, rise / (2 * h), 1e-9);
    }
}

TEST(heat_transfer, drifts_with_the_inlet) {  // oracle: analytic frequency response from the inlet, by Fourier sums
    HeatTransferParameters p = exact();
    p.drift = 0.4;
    p.drift_period = 500;
    const Index period = 500, settled = 2000;
    const double w = 2 * M_PI / p.drift_period;
    const Vector y = response(p, Vector::Constant(settled + period, 4), 1);
    Complex sum = 0;
    for (Index k = settled; k < settled + period; ++k) sum += y[k] * std::exp(Complex(0, -w * static_cast<double>(k)));
    const Complex s(0, w), heater = p.heater_capacity * s + p.transfer;
    const Complex air =
        p.flow * heater / (heater * (p.air_capacity * s + p.transfer + p.flow) - p.transfer * p.transfer);
    const Complex sensor = 1. / (p.sensor_time * s + 1.);
    EXPECT_NEAR(2 * std::abs(sum) / static_cast<double>(period), p.drift * std::abs(air * sensor), 1e-6);
    EXPECT_NEAR(y.tail(period).mean(), heat_transfer_truth(p, 4).temperature, 1e-6);
}

TEST(heat_transfer, sensor_adds_the_stated_noise_and_rounds) {  // oracle: definition, statistics
    HeatTransferParameters p;
    p.drift = 0;
    const Vector y = response(p, Vector::Constant(20000, 4), 1, 3);
    const Vector error = y.array() - heat_transfer_truth(p, 4).temperature;
    const double expected = std::sqrt(p.noise_std * p.noise_std + p.resolution * p.resolution / 12);
    EXPECT_NEAR(std::sqrt(error.squaredNorm() / 20000), expected, 5 * expected / std::sqrt(2 * 20000));
    for (const double value : y) EXPECT_NEAR(value / p.resolution, std::round(value / p.resolution), 1e-9);
}

TEST(heat_transfer, experiments_stand_about_their_operating_points) {  // oracle: definition, statics
    const HeatTransferParameters p;
    const HeatTransferExperiments plan;
    const HeatTransferData one = simulate_heat_transfer(p, plan, 4), again = simulate_heat_transfer(p, plan, 4),
                           other = simulate_heat_transfer(p, plan, 5);
    EXPECT_EQ(one.estimation.y, again.estimation.y);
    EXPECT_EQ(one.high.y, again.high.y);
    EXPECT_NE(one.estimation.y, other.estimation.y);
    EXPECT_NE(one.estimation.u, one.validation.u);
    for (const auto& [data_set, point] : {std::pair(&one.estimation, plan.low), std::pair(&one.validation, plan.low),
                                          std::pair(&one.high, plan.high)}) {
        EXPECT_EQ(data_set->t.size(), data_set->y.size());
        EXPECT_EQ(data_set->u[0], point);
        EXPECT_EQ(data_set->u.maxCoeff(), point + plan.amplitude);
        EXPECT_EQ(data_set->u.minCoeff(), point - plan.amplitude);
        EXPECT_NEAR(data_set->y.head(50).mean(), heat_transfer_truth(p, point).temperature, p.drift + 0.1);
    }
}

TEST(heat_transfer, refuses_what_is_not_physical) {
    HeatTransferParameters p;
    p.flow = 0;
    EXPECT_THROW(heat_transfer_truth(p, 4), InvalidArgument);
    HeatTransferExperiments plan;
    plan.low = 0.5;
    EXPECT_THROW(simulate_heat_transfer({}, plan, 1), InvalidArgument);
    EXPECT_THROW(response({}, Vector(), 1), InvalidArgument);
    EXPECT_THROW(response({}, Vector::Constant(5, std::nan("")), 1), InvalidArgument);
}

}  // namespace test_heat_transfer
