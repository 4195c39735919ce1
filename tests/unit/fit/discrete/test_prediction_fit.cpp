#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/discrete/prediction_fit.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_prediction_fit {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

PolynomialOrders armax_orders() {
    PolynomialOrders orders = PolynomialOrders::arx(1, {1}, {1});
    orders.nc = 1;
    return orders;
}
const Vector kTruth{{-0.8, 0.5, 0.4}};

IdData simulated_data(Index N) {
    const Vector u = random_levels(N, 3, 7), e = 0.1 * RandomStream(1).normal(N);
    return IdData(Matrix(model_output(PolynomialModel(armax_orders(), kTruth, 1), u, e)), Matrix(u), 1);
}

TEST(prediction_fit,
     its_minimum_is_stationary) {  // oracle: central differences of the model's own loss, its size by hand
    const IdData data = simulated_data(2000);
    const std::vector<SampledExperiment> experiments = sampled_experiments(data);
    const StartCondition start{InitialState::kEstimate, false};
    const PredictionModel model(armax_orders(), start, experiments);
    FitOptions options;
    options.tolerance = 1e-10;
    const Fit fit = fit_prediction("armax", model, start, 1, {Vector{{-0.5, 0.5, 0.0}}, kTruth}, options);
    const Vector y = model.target();
    const auto loss = [&](const Vector& theta) {
        Vector output;
        model.simulate(theta, output, nullptr);
        return (y - output).squaredNorm() / static_cast<double>(y.size());
    };
    EXPECT_NEAR(fit.loss, loss(fit.theta), 1e-15);
    for (Index i = 0; i < 3; ++i) {
        const Vector h = 1e-5 * Vector::Unit(3, i);
        EXPECT_NEAR((loss(fit.theta + h) - loss(fit.theta - h)) / 2e-5, 0, 1e-7 * fit.loss / 1e-2) << i;
        EXPECT_NEAR(fit.theta[i], kTruth[i], 4 * fit.std[i]) << i;
    }
    EXPECT_NEAR(fit.noise_variance[0], 0.01, 0.001);
    EXPECT_THAT(message_text(fit.full_message()), HasSubstr("The search converged after"));
    EXPECT_THAT(thrown_message([&] {
                    const IdData few = data.range(1, 4);
                    const std::vector<SampledExperiment> short_ones = sampled_experiments(few);
                    fit_prediction("armax", PredictionModel(armax_orders(), start, short_ones), start, 1, {kTruth},
                                   options);
                }),
                HasSubstr("armax estimates 3 values and needs more samples than that"));
}

TEST(prediction_fit, a_start_for_the_noise) {  // oracle: the simulated noise; rounding is none
    const Vector e = RandomStream(3).normal(5000);
    Vector v = e;
    v.tail(4999) += 0.6 * e.head(4999);
    const ArmaNoise noise = start_noise({v}, 1, 0, 1);
    EXPECT_NEAR(noise.C[1], 0.6, 0.06);
    EXPECT_EQ(start_noise({1e-14 * v}, 1, 0, 1).C[1], 0);
    EXPECT_NEAR(output_power(IdData(Matrix(v), Matrix(e), 1)), v.squaredNorm() / 5000, 1e-12);
}

}  // namespace test_prediction_fit
