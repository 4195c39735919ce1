#include <gtest/gtest.h>

#include "numerics/error.h"
#include "numerics/plants/first_order_step.h"
#include "numerics/signals/random.h"

namespace test_first_order_step {

using namespace dynlab;

TEST(first_order_step, satisfies_both_descriptions) {  // oracle: definition of the two models
    const FirstOrderStepParameters p;
    const FirstOrderStepTruth truth = first_order_step_truth(p);
    const FirstOrderStepData data_set = simulate_first_order_step(p, 1);
    ASSERT_EQ(data_set.t.size(), 4);
    for (Index k = 0; k < 4; ++k)
        EXPECT_NEAR(data_set.ydot[k], truth.a * data_set.y[k] + truth.b * data_set.u[k], 1e-14);
    for (Index k = 0; k < 3; ++k)
        EXPECT_NEAR(data_set.y[k + 1], truth.f * data_set.y[k] + truth.g * data_set.u[k], 1e-14);
}

TEST(first_order_step, noise_is_the_normal_stream) {  // oracle: definition
    const FirstOrderStepParameters p;
    const FirstOrderStepData data_set = simulate_first_order_step(p, 7);
    RandomStream random(7);
    const Vector first = random.normal(4), second = random.normal(4);
    EXPECT_LT((data_set.y_noisy - data_set.y - p.output_noise_std * first).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((data_set.ydot_noisy - data_set.ydot - p.derivative_noise_std * second).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(first_order_step, refuses_what_is_no_experiment) {
    FirstOrderStepParameters p;
    p.samples = 1;
    EXPECT_THROW(simulate_first_order_step(p, 1), InvalidArgument);
    p = {};
    p.time_constant = 0;
    EXPECT_THROW(simulate_first_order_step(p, 1), InvalidArgument);
}

}  // namespace test_first_order_step
