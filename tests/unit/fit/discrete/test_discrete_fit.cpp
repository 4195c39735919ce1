#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/operating_points.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_discrete_fit {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const PolynomialOrders kOrders = PolynomialOrders::output_error({1}, {1}, {1});
const Vector kTruth{{-0.7, 0.5}};

IdData simulated_data(Index N, double offset) {
    const Vector u = random_levels(N, 3, 7).array() + 2, e = Vector::Zero(N);
    const Vector y = model_output(PolynomialModel(kOrders, kTruth, 1), u, e).array() + offset;
    return IdData(Matrix(y + 0.05 * RandomStream(1).normal(N)), Matrix(u), 1);
}

Fit fitted(const IdData& data, InitialState state, Offset offset) {
    FitOptions options;
    options.initial_state = state;
    options.offset = offset;
    options.tolerance = 1e-10;
    return fit_discrete_output("oe", data, kOrders, options, output_error_search(options));
}

TEST(discrete_fit, chooses_the_start_that_made_the_record) {  // oracle: the simulated system
    const Fit rest = fitted(simulated_data(500, 0), InitialState::kAuto, Offset::kAuto);
    EXPECT_EQ(rest.start.state, InitialState::kZero) << message_text(rest.full_message());
    EXPECT_FALSE(rest.start.offset);
    const Fit lifted = fitted(simulated_data(500, 3), InitialState::kAuto, Offset::kAuto);
    EXPECT_EQ(lifted.start.state, InitialState::kZero) << message_text(lifted.full_message());
    EXPECT_TRUE(lifted.start.offset);
    EXPECT_NEAR(lifted.offsets(0, 0), 3, 0.05);
    const Fit running = fitted(simulated_data(600, 0).range(101, 600), InitialState::kAuto, Offset::kNone);
    EXPECT_NE(running.start.state, InitialState::kZero) << message_text(running.full_message());
    for (const Fit* fit : {&rest, &lifted, &running})
        for (Index i = 0; i < 2; ++i)
            EXPECT_NEAR(fit->theta[i], kTruth[i], 4 * fit->std[i]) << message_text(fit->full_message());
}

TEST(discrete_fit, measures) {  // oracle: the simulation, sample by sample
    const IdData data = simulated_data(400, 0);
    const Fit fit = fitted(data, InitialState::kZero, Offset::kNone);
    const Vector y = data.experiments[0].y, u = data.experiments[0].u;
    double squares = 0, x = 0;
    for (Index k = 0; k < 400; ++k) {
        if (k > 0) x = -fit.theta[0] * x + fit.theta[1] * u[k - 1];
        squares += std::pow(y[k] - x, 2);
    }
    EXPECT_NEAR(fit.loss, squares / 400, 1e-12);
    EXPECT_NEAR(fit.noise_variance[0], squares / 398, 1e-12);
    EXPECT_NEAR(fit.fit_percent[0], 100 * (1 - std::sqrt(squares / (y.array() - y.mean()).square().sum())), 1e-9);
}

TEST(discrete_fit, the_operating_point_comes_off) {  // oracle: second route, the centered data
    const IdData data = simulated_data(400, 10);
    const CenteredData centered = without_operating_points(data);
    const Fit removed = fitted(data, InitialState::kZero, Offset::kRemove);
    const Fit by_hand = fitted(centered.data, InitialState::kZero, Offset::kNone);
    EXPECT_LT((removed.theta - by_hand.theta).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(removed.offsets(0, 0), centered.removed[0][0].output);
    EXPECT_EQ(sampled_experiments(data)[0].u, data.experiments[0].u);
    PolynomialOrders with_noise = kOrders;
    with_noise.nd = 1;
    EXPECT_THAT(thrown_message([&] { fit_discrete_output("oe", data, with_noise, {}, output_error_search({})); }),
                HasSubstr("oe has only the orders nb, nf and nk"));
}

}  // namespace test_discrete_fit
