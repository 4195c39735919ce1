#include <gtest/gtest.h>

#include "numerics/fit/discrete/prediction_model.h"
#include "support/difference_equation.h"

namespace test_prediction_model {

using namespace dynlab;
using namespace dynlab::test;

/// Everything at once: A, two inputs with an F each, C and D.
PolynomialOrders full_orders() {
    PolynomialOrders orders = PolynomialOrders::output_error({2, 1}, {1, 2}, {1, 0});
    orders.na = 2;
    orders.nc = 1;
    orders.nd = 2;
    return orders;
}

const Vector kTheta{{-1.2, 0.5, -0.7, 1, 0.5, -0.4, 0.2, -2, 0.6, -0.3, 0.1}};

std::vector<SampledExperiment> data_sets(double noise) {
    std::vector<SampledExperiment> list;
    for (const Index N : {120, 90}) {
        Matrix u(N, 2);
        u << random_levels(N, 3, 1), random_levels(N, 5, 2);
        const Vector e = noise * RandomStream(static_cast<std::uint32_t>(N)).normal(N);
        list.push_back({u, model_output(PolynomialModel(full_orders(), kTheta, 1), u, e)});
    }
    return list;
}

const StartCondition kConditions[] = {{InitialState::kZero, false},
                                      {InitialState::kZero, true},
                                      {InitialState::kEstimate, false},
                                      {InitialState::kEstimate, true}};

TEST(prediction_model, sensitivities_are_those_of_its_output) {  // oracle: central differences
    const auto experiments = data_sets(0.3);
    for (const StartCondition& condition : kConditions) {
        const PredictionModel model(full_orders(), condition, experiments);
        Vector theta = Vector::Constant(model.parameter_count(), 0.2), output;
        theta.head(kTheta.size()) = kTheta;
        Matrix sensitivities;
        model.simulate(theta, output, &sensitivities);
        ASSERT_EQ(output.size(), model.target().size());
        for (Index i = 0; i < theta.size(); ++i) {
            constexpr double kStep = 1e-6;
            Vector up, down;
            model.simulate(theta + kStep * Vector::Unit(theta.size(), i), up, nullptr);
            model.simulate(theta - kStep * Vector::Unit(theta.size(), i), down, nullptr);
            const Vector difference = (up - down) / (2 * kStep);
            EXPECT_LT((difference - sensitivities.col(i)).cwiseAbs().maxCoeff(), 1e-7 * (1 + difference.norm())) << i;
        }
    }
}

TEST(prediction_model, products_are_those_of_its_sensitivities) {  // oracle: second route, the stored sensitivities
    const auto experiments = data_sets(0.3);
    for (const StartCondition& condition : kConditions) {
        const PredictionModel model(full_orders(), condition, experiments);
        Vector theta = Vector::Constant(model.parameter_count(), 0.2);
        theta.head(kTheta.size()) = kTheta;
        const Vector y = model.target();
        const OutputErrorProducts fast = model.products(theta, y), plain = model.OutputErrorModel::products(theta, y);
        EXPECT_NEAR(fast.squares, plain.squares, 1e-11 * plain.squares);
        EXPECT_LT((fast.gram - plain.gram).norm(), 1e-11 * plain.gram.norm());
        EXPECT_LT((fast.descent - plain.descent).norm(), 1e-11 * std::sqrt(plain.squares * plain.gram.norm()));
    }
}

TEST(prediction_model, errors_are_the_noise_that_went_in) {  // oracle: the simulated noise, once the start has decayed
    const auto experiments = data_sets(0.3);
    const PredictionModel model(full_orders(), {InitialState::kZero, false}, experiments);
    Vector output;
    model.simulate(kTheta, output, nullptr);
    const Vector errors = model.target() - output;
    Index first = 0;
    for (const Index length : model.lengths()) {
        const Index N = length + 2;
        const Vector e = 0.3 * RandomStream(static_cast<std::uint32_t>(N)).normal(N);
        EXPECT_LT((errors.segment(first + 60, length - 60) - e.tail(length - 60)).cwiseAbs().maxCoeff(), 1e-12);
        first += length;
    }
    EXPECT_EQ(first, errors.size());
}

TEST(prediction_model, simulation_ignores_the_noise) {  // oracle: the difference equation without noise
    const auto experiments = data_sets(0);
    const PredictionModel model(full_orders(), {InitialState::kZero, false}, experiments);
    EXPECT_LT((model.simulated(kTheta) - model.target()).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(prediction_model, without_noise_model_it_is_the_output) {  // oracle: DiscreteOutput
    PolynomialOrders orders = PolynomialOrders::output_error({2, 1}, {1, 2}, {1, 0});
    const auto experiments = data_sets(0.3);
    for (const StartCondition& condition : kConditions) {
        const PredictionModel model(orders, condition, experiments);
        const DiscreteOutput other(orders, condition, experiments);
        Vector theta = Vector::Constant(model.parameter_count(), 0.2), output, expected;
        Matrix J, expected_J;
        model.simulate(theta, output, &J);
        other.simulate(theta, expected, &expected_J);
        EXPECT_LT((output - expected).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_EQ(J, expected_J);
        EXPECT_EQ(model.target(), other.target());
    }
}

TEST(prediction_model, stays_where_the_noise_model_can_be_inverted) {  // oracle: definition
    const auto experiments = data_sets(0.3);
    const PredictionModel model(full_orders(), {InitialState::kZero, false}, experiments);
    Vector theta = kTheta, output;
    theta[8] = 1.1;  // c1
    model.simulate(theta, output, nullptr);
    EXPECT_FALSE(output.allFinite());
}

}  // namespace test_prediction_model
