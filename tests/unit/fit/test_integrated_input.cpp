#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/integrated_input.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_integrated_input {

using namespace dynlab;
using namespace dynlab::test;

const TransferFunction kPosition(values({3}), values({1, 2, 0}), 0, 0.12);  // a motor: 3/(s (s + 2)), late

TEST(integrated_input, models_get_the_integrator_of_the_system) {  // oracle: the simulated system
    const Vector u = prbs(7, 6);
    const IdData data(Matrix(lsim(kPosition, u, 0.05)), Matrix(u), 0.05);
    FitOptions options;
    options.tolerance = 1e-10;
    Fit estimate = srivc(integrated_inputs(data), TransferStructure::single(1, 0, 0.12), options);
    append_integrator(estimate);
    EXPECT_LT((estimate.models[0].den() - kPosition.den()).cwiseAbs().maxCoeff(), 1e-6)
        << message_text(estimate.full_message());
    EXPECT_LT((estimate.models[0].num() - kPosition.num()).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(estimate.models[0].delay(), 0.12);
    EXPECT_GT(estimate.fit_percent[0], 100 - 1e-5);
}

TEST(integrated_input, irregular_sampling_counts_every_step) {  // oracle: the simulated system
    Vector t(400);
    t[0] = 0;
    const Vector jitter = RandomStream(1).normal(400).cwiseAbs();
    for (Index k = 1; k < 400; ++k) t[k] = t[k - 1] + 0.02 + 0.02 * jitter[k];
    const Vector u = random_levels(400, 7, 2);
    const TransferFunction G = kPosition.with_delay(0);
    const IdData data(Matrix(lsim(G, u, t)), Matrix(u), t);
    FitOptions options;
    options.tolerance = 1e-10;
    Fit estimate = srivc(integrated_inputs(data), TransferStructure::single(1, 0), options);
    append_integrator(estimate);
    EXPECT_LT((estimate.models[0].den() - G.den()).cwiseAbs().maxCoeff(), 1e-5)
        << message_text(estimate.full_message());
}

TEST(integrated_input, running_sums_do_the_same_in_discrete_time) {  // oracle: the simulated system
    PolynomialOrders orders = PolynomialOrders::output_error({2}, {2}, {1});
    const PolynomialModel truth(orders, Vector{{-1.7, 0.7, 1, 0.5}}, 0.1);  // poles 1 and 0.7
    const Vector u = random_levels(500, 4, 1);
    const IdData data(Matrix(model_output(truth, u, Vector::Zero(500))), Matrix(u), 0.1);
    Fit estimate = oe(summed_inputs(data), PolynomialOrders::output_error({2}, {1}, {1}));
    append_integrator(estimate);
    EXPECT_LT((estimate.polynomial->F[0] - truth.F[0]).cwiseAbs().maxCoeff(), 1e-8)
        << message_text(estimate.full_message());
    EXPECT_LT((estimate.polynomial->B[0] - truth.B[0]).cwiseAbs().maxCoeff(), 1e-8);
}

/// The data without the first `lost` samples: the motor then begins at an unknown position, and turns.
IdData later_part(Index lost) {
    const Vector u = random_levels(600, 5, 1).array() + 0.02, noise = RandomStream(2).normal(600);
    const Vector y = lsim(kPosition.with_delay(0), u, 0.1) + 0.01 * noise;
    return IdData(Matrix(y.tail(600 - lost)), Matrix(u.tail(600 - lost)), 0.1);
}

TEST(integrated_input, what_the_integrator_held_before_the_record_is_estimated) {  // oracle: the simulated system
    const IdData data = later_part(100);
    for (const InitialState state : {InitialState::kEstimate, InitialState::kAuto}) {
        FitOptions options;
        options.initial_state = state;
        options = options_with_integrator(options);
        const Fit estimate = srivc(integrated_inputs(data), TransferStructure::single(1, 0), options);
        EXPECT_LT(std::abs(estimate.theta[0] - 2), 5 * estimate.std[0]) << message_text(estimate.full_message());
        EXPECT_LT(std::abs(estimate.theta[1] - 3), 5 * estimate.std[1]);
        EXPECT_GT(estimate.fit_percent[0], 95);
        const Fit sampled = oe(summed_inputs(data), PolynomialOrders::output_error({2}, {1}, {1}), options);
        EXPECT_NEAR(sampled.theta[0], -std::exp(-0.2), 0.01) << message_text(sampled.full_message());
        EXPECT_GT(sampled.fit_percent[0], 95);
    }
}

TEST(integrated_input, has_no_operating_point) {  // oracle: definition
    FitOptions options = FitOptions().from_rest();
    options.offset = Offset::kRemove;
    EXPECT_THAT(thrown_message([&] { options_with_integrator(options); }),
                testing::HasSubstr("`offset` = \"remove\" cannot be combined with `integration`"));
    options.offset = Offset::kNone;
    EXPECT_EQ(options_with_integrator(options).offset, Offset::kNone);  // from rest nothing is unknown
}

TEST(integrated_input, needs_a_held_input) {  // oracle: definition
    IdData data(Matrix::Random(10, 1), Matrix::Random(10, 1), 1);
    data.hold = Hold::kFoh;
    EXPECT_THAT(thrown_message([&] { integrated_inputs(data); }), testing::HasSubstr("zero-order hold"));
}

}  // namespace test_integrated_input
