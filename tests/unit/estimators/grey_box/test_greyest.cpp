#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/grey_box/greyest.h"
#include "numerics/plants/crane_experiments.h"
#include "numerics/validation/grey_box/grey_comparison.h"
#include "support/grey_cases.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_greyest {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

/// b/(s^2 + a1 s + a2) in controllable form.
GreyModel second_order() {
    return grey_model({{"a1", 1, 0}, {"a2", 1, 0}, {"b", 1}}, {"y", "dy"}, [](const Variables& v) -> std::vector<Term> {
        return {v.x[1], v.p[2] * v.u - v.p[0] * v.x[1] - v.p[1] * v.x[0]};
    });
}

GreyOptions tight() {
    GreyOptions options;
    options.tolerance = 1e-11;
    options.relative_tolerance = 1e-11;
    return options;
}

Fit output_error_fit(const IdData& data, InitialState state = InitialState::kZero) {
    FitOptions options;
    options.tolerance = 1e-11;
    options.initial_state = state;
    return coe(data, TransferStructure::single(2, 0), options);
}

TEST(greyest, of_a_linear_model_is_coe) {  // oracle: second route, coe, with its standard errors
    for (const Hold hold : {Hold::kZoh, Hold::kFoh}) {
        IdData data = course_system_data(0.2, 3);
        data.hold = hold;
        const Fit expected = output_error_fit(data);
        const GreyFit found = greyest(data, second_order(), tight());
        EXPECT_LT(relative_difference(found.fit.theta, expected.theta), 1e-7) << message_text(found.fit.full_message());
        EXPECT_LT(relative_difference(found.fit.std, expected.std), 1e-7);
        EXPECT_NEAR(found.fit.noise_variance[0], expected.noise_variance[0], 1e-9);
        EXPECT_NEAR(found.fit.fit_percent[0], expected.fit_percent[0], 1e-7);
    }
}

TEST(greyest, by_steps_is_coe_too) {  // oracle: second route; a sine too small to matter keeps it from the exact one
    const IdData data = course_system_data(0.2, 3);
    const GreyModel model =
        grey_model({{"a1", 1, 0}, {"a2", 1, 0}, {"b", 1}}, {"y", "dy"}, [](const Variables& v) -> std::vector<Term> {
            return {v.x[1], v.p[2] * v.u - v.p[0] * v.x[1] - v.p[1] * v.x[0] + 1e-25 * sine(v.x[0])};
        });
    const Fit expected = output_error_fit(data);
    const GreyFit found = greyest(data, model, tight());
    EXPECT_LT(relative_difference(found.fit.theta, expected.theta), 1e-7) << message_text(found.fit.full_message());
    EXPECT_LT(relative_difference(found.fit.std, expected.std), 1e-7);
}

TEST(greyest, with_an_estimated_initial_state_is_coe) {  // oracle: second route
    IdData data = course_system_data(0.2, 5).range(301, 1200);
    const Fit expected = output_error_fit(data, InitialState::kEstimate);
    GreyOptions options = tight();
    options.initial_state = GreyStart::kEstimate;
    const GreyFit found = greyest(data, second_order(), options);
    EXPECT_LT(relative_difference(found.fit.theta, expected.theta), 1e-6) << message_text(found.fit.full_message());
    EXPECT_LT(relative_difference(found.fit.std, expected.std), 1e-6);
    EXPECT_GT(found.initial_std.minCoeff(), 0);
}

// Oracle: by hand. Two samples of the free decay x(t) = h exp(-r t) determine h and r: r = log(y1/y2)/Ts, and the
// errors follow from the inverse of the 2 x 2 sensitivities.
TEST(greyest, of_two_parameters_by_hand) {
    const GreyModel model = grey_model(
        {{"h", 1}, {"r", 1, 0}}, {"x"}, [](const Variables& v) -> std::vector<Term> { return {-v.p[1] * v.x[0]}; }, {},
        [](const Variables& v) -> std::vector<Term> { return {v.p[0]}; });
    const Vector y{{4, 2, 1.1}}, u = Vector::Zero(3);
    const GreyFit found = greyest(IdData(Matrix(y), Matrix(u), 0.5), model, tight());
    // least squares of three samples: sum (y_k - h q^k) q^k = 0 and sum k (y_k - h q^k) q^(k-1) = 0 with q = exp(-r/2)
    const double h = found.fit.theta[0], q = std::exp(-0.5 * found.fit.theta[1]);
    const Vector e{{y[0] - h, y[1] - h * q, y[2] - h * q * q}};
    EXPECT_NEAR(e[0] + e[1] * q + e[2] * q * q, 0, 1e-9);
    EXPECT_NEAR(e[1] + 2 * e[2] * q, 0, 1e-9);
    Matrix J(3, 2);
    J << 1, 0, q, -0.5 * h * q, q * q, -h * q * q;
    const double s11 = J.col(0).squaredNorm(), s12 = J.col(0).dot(J.col(1)), s22 = J.col(1).squaredNorm();
    Matrix covariance(2, 2);
    covariance << s22, -s12, -s12, s11;
    covariance *= e.squaredNorm() / (s11 * s22 - s12 * s12);  // one degree of freedom
    EXPECT_LT((found.fit.covariance - covariance).cwiseAbs().maxCoeff(), 1e-8);
}

/// A pendulum swinging far, in the parameters a, b, c.
IdData swinging(double noise, std::uint32_t seed, const Vector& p = Vector{{9, 3, 0.4}}) {
    const Vector u = prbs(5, 6);
    GreyInputs inputs{Matrix(u), Vector(0.05 * Vector::LinSpaced(u.size(), 0, static_cast<double>(u.size() - 1)))};
    const GreyModel model = pendulum(1, 1, 1);
    const Matrix y = GreySimulator(model, 2, {}, 1e-11).run(p, inputs, {}, false).y;
    Matrix noisy = y;
    RandomStream random(seed);
    noisy.col(0) += noise * random.normal(u.size());
    noisy.col(1) += 5 * noise * random.normal(u.size());
    return IdData(noisy, Matrix(u), 0.05);
}

TEST(greyest, recovers_a_pendulum_without_noise) {  // oracle: the simulated system
    const GreyFit found = greyest(swinging(0, 1), pendulum(8, 2.5, 0.5), tight());
    EXPECT_LT((found.fit.theta - Vector{{9, 3, 0.4}}).cwiseAbs().maxCoeff(), 1e-7)
        << message_text(found.fit.full_message());
}

TEST(greyest, weighs_outputs_by_their_noise) {  // oracle: the noise of each output
    const GreyFit found = greyest(swinging(0.05, 2), pendulum(8, 2.5, 0.5));
    EXPECT_NEAR(std::sqrt(found.fit.noise_variance[0]), 0.05, 0.008);
    EXPECT_NEAR(std::sqrt(found.fit.noise_variance[1]), 0.25, 0.04);
    for (Index i = 0; i < 3; ++i) EXPECT_NEAR(found.fit.theta[i], Vector({{9, 3, 0.4}})[i], 4 * found.fit.std[i]) << i;
    EXPECT_LT(found.fit.std[0], 0.2);
}

TEST(greyest, several_experiments_count_together) {  // oracle: the same data twice halve the variance
    const IdData one = swinging(0.05, 2);
    const GreyFit single = greyest(one, pendulum(8, 2.5, 0.5), tight()),
                  both = greyest(IdData::merge({one, one}), pendulum(8, 2.5, 0.5), tight());
    EXPECT_LT(relative_difference(both.fit.theta, single.fit.theta), 1e-6);
    const double N = static_cast<double>(one.sample_count());
    EXPECT_NEAR(both.fit.covariance(0, 0) / single.fit.covariance(0, 0), 0.5 * (2 * N - 3) / (2 * N - 1.5), 1e-4);
}

TEST(greyest, keeps_to_bounds_and_fixed_values) {  // oracle: definition, and the search with the bound fixed
    GreyModel model = pendulum(8, 2.5, 0.5);
    model.parameters[2].lower = 0.45;  // the truth lies below
    const IdData data = swinging(0.02, 3);
    const GreyFit bounded = greyest(data, model, tight());
    EXPECT_EQ(bounded.fit.theta[2], 0.45);
    EXPECT_TRUE(bounded.fit.at_bound[2]);
    EXPECT_EQ(bounded.fit.std[2], 0);
    EXPECT_THAT(message_text(bounded.fit.full_message()), HasSubstr("The parameter c ended at its bound 0.45"));
    model.parameters[2] = {"c", 0.45, -kInfinity, kInfinity, true};
    const GreyFit fixed = greyest(data, model, tight());
    EXPECT_LT((fixed.fit.theta - bounded.fit.theta).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(fixed.fit.std[2], 0);
}

TEST(greyest, reports_what_the_record_does_not_show) {  // oracle: only the quotient k/m acts
    const GreyModel model =
        grey_model({{"k", 2, 0}, {"m", 0.5, 0}}, {"x"},
                   [](const Variables& v) -> std::vector<Term> { return {v.p[0] / v.p[1] * (v.u - v.x[0])}; });
    const Vector u = prbs(5, 4);
    const Vector y =
        lsim(TransferFunction(values({3}), values({1, 3})), u, 0.1) + 0.01 * RandomStream(1).normal(u.size());
    const GreyFit found = greyest(IdData(Matrix(y), Matrix(u), 0.1), model);
    EXPECT_NEAR(found.fit.theta[0] / found.fit.theta[1], 3, 0.1);
    EXPECT_THAT(message_text(found.fit.full_message()), HasSubstr("cannot separate k, m"));
    EXPECT_THAT(message_text(found.fit.full_message()), HasSubstr("k +1 %, m +1 %"));
    EXPECT_TRUE(std::isinf(found.fit.std[0]) && std::isinf(found.fit.std[1]));
}

TEST(greyest, finds_the_best_of_several_starts) {  // oracle: the simulated system
    const Vector u = Vector::Zero(200);
    Vector y(200);
    for (Index k = 0; k < 200; ++k) y[k] = std::sin(0.05 * 7 * static_cast<double>(k));
    const GreyModel model = grey_model(
        {{"w", 30, 1, 60}}, {"x", "v"},
        [](const Variables& v) -> std::vector<Term> {
            return {v.p[0] * v.x[1], -v.p[0] * v.x[0]};
        },
        [](const Variables& v) -> std::vector<Term> { return {v.x[0]}; },
        [](const Variables& v) -> std::vector<Term> {
            return {number(v.u, 0), number(v.u, 1)};
        });
    const IdData data(Matrix(y), Matrix(u), 0.05);
    EXPECT_NEAR(greyest(data, model).fit.theta[0], 7, 1e-5) << "over longer and longer beginnings";
    GreyOptions options;
    options.starts = 60;
    EXPECT_NEAR(greyest(data, model, options).fit.theta[0], 7, 1e-5);
    options = {};
    options.further_starts = {{{"w", 7.1}}};
    EXPECT_NEAR(greyest(data, model, options).fit.theta[0], 7, 1e-5);
}

TEST(greyest, estimates_the_initial_state_of_other_records) {  // oracle: the simulated system
    const IdData data = swinging(0.001, 4);
    GreyOptions options;
    options.initial_state = GreyStart::kEstimate;
    const GreyFit found = greyest(data.range(40, 120), pendulum(8, 2.5, 0.5), options);
    EXPECT_NEAR(found.initial_states(0, 0), data.experiments[0].y(39, 0), 0.01);
    const Comparison later = compare_grey(data.range(121, 180), found, usual_start(found));
    EXPECT_GT(later.fit_percent.minCoeff(), 99);
    const Comparison from_zero = compare_grey(data.range(121, 180), found, GreyStart::kZero);
    EXPECT_LT(from_zero.fit_percent.minCoeff(), 90);
}

/// Position from the first sample on, and angle.
IdData crane_data(const CraneData& crane) {
    Matrix y(crane.u.size(), 2);
    y << crane.x.array() - crane.x[0], crane.theta;
    return IdData(y, Matrix(crane.u), 0.02);
}

// Oracle: the simulated plant, whose friction, belt, motor and sensors are richer than the model's seven parameters.
// Its best linear model reaches 96.4 % of the angle on the validation data.
TEST(greyest, explains_the_crane_better_than_any_linear_model) {
    const std::vector<CraneData> data_sets = simulate_crane({}, {}, 1);
    const GreyFit found = greyest(crane_data(data_sets[0]), crane_model());
    const Vector validation = compare_grey(crane_data(data_sets[1]), found, GreyStart::kModel).fit_percent;
    EXPECT_GE(validation[0], 99.7) << message_text(found.fit.full_message());
    EXPECT_GE(validation[1], 98.0);
    EXPECT_NEAR(found.fit.theta[4], (1e-3 + 0.23 * 0.36 * 0.36) / (0.23 * 0.36), 1e-3);  // the equivalent length, m
    EXPECT_NEAR(found.fit.theta[6], 0.012, 5e-4);                                        // what the sensor adds, rad
    EXPECT_NEAR(std::sqrt(found.fit.noise_variance[1]), 2e-3, 3e-4);
}

TEST(greyest, refuses_what_it_cannot_fit) {  // oracle: definitions
    const IdData data = swinging(0.01, 1);
    const auto refusal = [&](GreyModel model, const GreyOptions& options = {}) {
        return thrown_message([&] { greyest(data, model, options); });
    };
    GreyModel model = pendulum(1, 1, 1);
    model.parameters[0].lower = 2;
    EXPECT_THAT(refusal(model),
                HasSubstr("initial value of the parameter a is 1, which is outside the bounds 2 and Inf"));
    model.parameters[0].upper = 1;
    EXPECT_THAT(refusal(model), HasSubstr("the lower bound must not exceed the upper bound"));
    model = pendulum(1, 1, 1);
    model.parameters[1].start = kNaN;
    EXPECT_THAT(refusal(model), HasSubstr("The initial value of the parameter b must be finite, but is NaN"));
    GreyOptions options;
    options.further_starts = {{{"q", 1}}};
    EXPECT_THAT(refusal(pendulum(1, 1, 1), options), HasSubstr("contains the parameter q"));
    options = {};
    options.output_weights = Vector::Ones(3);
    EXPECT_THAT(refusal(pendulum(1, 1, 1), options),
                HasSubstr("needs one positive number for each of the 2 outputs, but has 3"));
    const GreyModel growing = grey_model({{"k", 50}}, {"x", "z"}, [](const Variables& v) -> std::vector<Term> {
        return {v.p[0] * v.x[0] * v.x[0] * v.x[0] + v.u, -v.x[1]};
    });
    EXPECT_THAT(refusal(growing), HasSubstr("the state x becomes infinite"));
    EXPECT_THAT(thrown_message([&] { greyest(data.select({1}, {1}).range(10, 11), pendulum(1, 1, 1)); }),
                HasSubstr("The number of samples, 2, must be greater than the number of parameters, 3"));
}

}  // namespace test_greyest
