#include "numerics/plants/drifting_process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "numerics/error.h"

namespace test_drifting_process {

using namespace dynlab;

DriftingProcessParameters exact() {
    DriftingProcessParameters p;
    p.noise_std = p.resolution = 0;
    return p;
}

TEST(drifting_process, scale_grows_and_is_taken_off) {  // oracle: the formulas, at instants where they are numbers
    const DriftingProcessParameters p;
    const double grown = 1 - 1 / M_E;
    EXPECT_DOUBLE_EQ(p.gain(0), 0.4);
    EXPECT_DOUBLE_EQ(p.time_constant(0), 20);
    EXPECT_NEAR(p.gain(1500), 0.4 * (1 - 0.45 * grown), 1e-12);
    EXPECT_NEAR(p.time_constant(1500), 20 * (1 + 0.8 * grown), 1e-12);
    EXPECT_DOUBLE_EQ(p.gain(3200), 0.4);
    EXPECT_NEAR(p.gain(4700), p.gain(1500), 1e-12);
    EXPECT_LT(p.gain(3199), 0.25);
}

TEST(drifting_process, without_scale_is_a_first_order_system) {  // oracle: analytic, sample by sample
    DriftingProcessParameters p = exact();
    p.lost_gain = p.more_time = 0;
    RandomStream random(1);
    const Vector u = 50 + 10 * random.normal(300).array();
    const Vector y = simulate_drifting_process(p, u, 2, random);
    double x = 0.4 * u[0];
    for (Index k = 0; k < 300; ++k) {
        EXPECT_NEAR(y[k], x, 1e-8) << k;
        x = 0.4 * u[k] + (x - 0.4 * u[k]) * std::exp(-2. / 20);
    }
}

// oracle: a second route, the exponential over hundredths of a second in which the coefficients are constant
TEST(drifting_process, follows_its_equation_across_the_cleaning) {
    DriftingProcessParameters p = exact();
    p.cleaning_time = 400.3;
    p.growth_time = 200;
    RandomStream random(2);
    const Vector u = 50 + 10 * random.normal(600).array(), y = simulate_drifting_process(p, u, 1, random);
    double x = p.gain(0) * u[0], worst = 0;
    for (Index k = 0; k < 600; ++k) {
        worst = std::max(worst, std::abs(x - y[k]));
        for (int i = 0; i < 100; ++i) {
            const double t = static_cast<double>(k) + 0.01 * (i + 0.5), steady = p.gain(t) * u[k];
            x = steady + (x - steady) * std::exp(-0.01 / p.time_constant(t));
        }
    }
    EXPECT_LT(worst, 1e-4);
    p.cleaning_time = 400;  // at a sample
    EXPECT_NO_THROW(simulate_drifting_process(p, u, 1, random));
}

TEST(drifting_process, sensor_is_as_stated) {  // oracle: statistics with fixed seed, and rounding
    DriftingProcessParameters p;
    p.lost_gain = 0;
    RandomStream random(3);
    const Vector noise =
        simulate_drifting_process(p, Vector::Constant(20000, 50.), 1, random).array() - p.clean_gain * 50;
    EXPECT_NEAR(std::sqrt(noise.squaredNorm() / 20000), std::hypot(0.6, 0.1 / std::sqrt(12.)), 0.012);
    for (double value : noise.head(100)) EXPECT_NEAR(value / 0.1, std::round(value / 0.1), 1e-7);
}

TEST(drifting_process, record_is_binary_and_follows_the_seed) {
    const PlantData one = simulate_drifting_process({}, {}, 3), again = simulate_drifting_process({}, {}, 3);
    EXPECT_EQ(one.y, again.y);
    EXPECT_NE(one.u, simulate_drifting_process({}, {}, 4).u);
    EXPECT_EQ(one.u.size(), 5100);
    EXPECT_EQ((one.u.array() - 50).abs().matrix(), Vector::Constant(5100, 20.));
}

TEST(drifting_process, refuses_what_is_not_physical) {
    DriftingProcessParameters p;
    p.lost_gain = 1;
    RandomStream random(1);
    EXPECT_THROW(simulate_drifting_process(p, Vector::Ones(3), 1, random), InvalidArgument);
    EXPECT_THROW(simulate_drifting_process({}, Vector(), 1, random), InvalidArgument);
    DriftingProcessExperiments plan;
    plan.high = plan.low;
    EXPECT_THROW(simulate_drifting_process({}, plan, 1), InvalidArgument);
}

}  // namespace test_drifting_process
