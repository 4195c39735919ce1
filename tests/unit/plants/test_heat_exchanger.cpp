#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/plants/heat_exchanger.h"

namespace test_heat_exchanger {

using namespace dynlab;

TEST(heat_exchanger, obeys_its_energy_balance) {  // oracle: residual of the differential equation
    HeatExchangerParameters p;
    p.noise_std = p.resolution = 0;
    p.Ts = 0.01;
    p.duration = 120;
    const PlantData data_set = simulate_heat_exchanger(p, 1);
    const double capacity = p.mass * p.specific_heat + p.wall_capacity;
    for (Index k : {1000, 6100, 9000, 11000}) {
        const double T = data_set.y[k], rate = (data_set.y[k + 1] - data_set.y[k - 1]) / (2 * p.Ts);
        const double heat = p.flow * p.specific_heat * (p.inlet_temperature - T) + p.loss * (p.room_temperature - T) +
                            p.power * data_set.u[k] / 100;
        EXPECT_NEAR(capacity * rate, heat, 1e-4 * p.power) << k;
    }
}

TEST(heat_exchanger, rests_before_and_after_the_step) {  // oracle: analytic equilibrium
    HeatExchangerParameters p;
    p.noise_std = p.resolution = 0;
    p.duration = 5000;
    const HeatExchangerTruth truth = heat_exchanger_truth(p);
    const PlantData data_set = simulate_heat_exchanger(p, 1);
    EXPECT_NEAR(data_set.y[0], truth.initial_output, 1e-12);
    EXPECT_NEAR(data_set.y[30], truth.initial_output, 1e-12);
    EXPECT_NEAR(data_set.y[data_set.y.size() - 1], truth.final_output, 1e-9);
    EXPECT_NEAR(truth.final_output - truth.initial_output, truth.gain * (p.valve_after - p.valve_before), 1e-12);
    EXPECT_EQ(data_set.u[29], p.valve_before);
    EXPECT_EQ(data_set.u[30], p.valve_after);
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
    const PlantData data_set = simulate_heat_exchanger(p, 3);
    for (double y : data_set.y) EXPECT_NEAR(y / p.resolution, std::round(y / p.resolution), 1e-6);
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

}  // namespace test_heat_exchanger
