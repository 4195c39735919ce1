#include <gtest/gtest.h>

#include "numerics/error.h"
#include "numerics/plants/suspension.h"

namespace test_suspension {

using namespace dynlab;

TEST(suspension, obeys_newtons_law) {  // oracle: residual of the differential equation
    SuspensionParameters p;
    p.noise_std = p.resolution = 0;
    p.Ts = 1e-4;
    p.step_time = 0.5;
    const PlantData data_set = simulate_suspension(p, 1);
    for (Index k : {100, 5100, 9000, 20000}) {
        const double h = p.Ts, x = 1e-3 * data_set.y[k];
        const double rate = 1e-3 * (data_set.y[k + 1] - data_set.y[k - 1]) / (2 * h);
        const double acceleration = 1e-3 * (data_set.y[k + 1] - 2 * data_set.y[k] + data_set.y[k - 1]) / (h * h);
        EXPECT_NEAR(p.mass * acceleration + p.damping * rate + p.stiffness * x, p.force_per_volt * data_set.u[k], 2e-4)
            << k;
    }
}

TEST(suspension, peaks_where_the_truth_says) {  // oracle: analytic
    SuspensionParameters p;
    p.noise_std = p.resolution = 0;
    p.Ts = 1e-4;
    const SuspensionTruth truth = suspension_truth(p);
    const PlantData data_set = simulate_suspension(p, 1);
    Index top = 0;
    const double peak = data_set.y.maxCoeff(&top);
    EXPECT_NEAR(data_set.t[top], truth.overshoot_time, p.Ts);
    EXPECT_NEAR(peak, truth.gain * (1 + truth.overshoot), 1e-6);
    EXPECT_EQ(data_set.y[0], 0);
    EXPECT_EQ(data_set.u.minCoeff(), 1);
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

}  // namespace test_suspension
