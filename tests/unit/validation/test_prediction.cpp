#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/estimators/armax.h"
#include "numerics/estimators/arx.h"
#include "numerics/estimators/bj.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/rivc.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/prediction.h"
#include "numerics/validation/residual_tests.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_prediction {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

NoisyModel noisy(const PolynomialModel& model) {
    NoisyModel all;
    for (std::size_t i = 0; i < model.B.size(); ++i) all.channels.push_back(model.transfer_function(i));
    all.polynomial = std::make_shared<PolynomialModel>(model);
    return all;
}

NoisyModel noisy(const Fit& fit) {
    if (fit.polynomial) return noisy(*fit.polynomial);
    NoisyModel all{fit.models, nullptr};
    all.C = fit.noise->C;
    all.D = fit.noise->D;
    return all;
}

PredictionOptions ahead(std::optional<Index> steps, InitialState state = InitialState::kZero,
                        Offset offset = Offset::kNone) {
    return {steps, {state, offset}};
}

const PolynomialOrders kArmax = [] {
    PolynomialOrders orders = PolynomialOrders::arx(2, {2}, {1});
    orders.nc = 2;
    return orders;
}();
const Vector kArmaxTheta{{-1.5, 0.7, 1, 0.5, -1, 0.3}};
const PolynomialOrders kBoxJenkins = [] {
    PolynomialOrders orders = PolynomialOrders::output_error({2}, {2}, {1});
    orders.nc = 1;
    orders.nd = 2;
    return orders;
}();
const Vector kBoxJenkinsTheta{{-1.2, 0.5, 1, 0.4, 0.5, -1.4, 0.6}};

struct Simulated {
    PolynomialModel model;
    Vector u, e, y;
    IdData data() const { return IdData(Matrix(y), Matrix(u), model.Ts); }
};

/// From rest. The first noise values are zero, as are those before the data.
Simulated simulated(const PolynomialOrders& orders, const Vector& theta, Index N, std::uint32_t seed = 1) {
    const PolynomialModel model(orders, theta, 0.5);
    Simulated all{model, random_levels(N, 3, seed + 50), 0.5 * RandomStream(seed).normal(N), {}};
    all.e.head(orders.nd).setZero();
    all.y = model_output(model, all.u, all.e);
    return all;
}

const PredictedOutput& only(const Predictions& all) {
    return all.results.front().front();
}

// Oracle: the definition. What is known k steps before a sample determines the output but for the noise from then on,
// whose expectation is zero.
TEST(prediction, is_the_output_without_the_noise_to_come) {
    for (const auto& [orders, theta] : {std::pair{kArmax, kArmaxTheta}, std::pair{kBoxJenkins, kBoxJenkinsTheta}}) {
        const Simulated s = simulated(orders, theta, 60);
        for (const Index k : {1, 2, 7}) {
            const Predictions all = predict(s.data(), noisy(s.model), ahead(k));
            EXPECT_EQ(only(all).first, orders.nd);
            EXPECT_LT((only(all).errors - s.e).cwiseAbs().maxCoeff(), 1e-12);
            for (Index t = orders.nd + k; t < 60; ++t) {
                Vector known = s.e;
                known.tail(60 - t + k - 1).setZero();
                EXPECT_NEAR(only(all).output[t], model_output(s.model, s.u, known)[t], 1e-10) << k << " at " << t;
            }
        }
        const Predictions run = predict(s.data(), noisy(s.model), ahead(std::nullopt));
        const Vector without = model_output(s.model, s.u, Vector::Zero(60));
        EXPECT_LT((only(run).output - without).tail(60 - orders.nd).cwiseAbs().maxCoeff(), 1e-12);
    }
}

/// Predictions of y(k) by a Kalman filter for the state of the observer form of A y = B u + C e,
///     x(k+1) = F x + G u + (C - A) e,  y = x_1 + e,
/// whose gain follows from a Riccati equation that is iterated from a wide start.
Vector kalman_predictions(const PolynomialModel& model, const Vector& u, const Vector& y, Index steps) {
    const Index n = model.A.size() - 1, N = y.size();
    Matrix F = Matrix::Zero(n, n);
    F.col(0) = -model.A.tail(n);
    F.topRightCorner(n - 1, n - 1).setIdentity();
    const Vector G = model.B[0].tail(n), K = model.C.tail(n) - model.A.tail(n);
    std::vector<Vector> states;  // x(k+1) given the outputs up to k
    Matrix P = 100 * Matrix::Identity(n, n);
    Vector x = Vector::Zero(n);
    for (Index k = 0; k < N; ++k) {
        const double innovation_variance = P(0, 0) + 1;
        const Vector gain = (F * P.col(0) + K) / innovation_variance;
        x = F * x + G * u[k] + gain * (y[k] - x[0]);
        P = (F * P * F.transpose() + K * K.transpose() - innovation_variance * gain * gain.transpose()).eval();
        states.push_back(x);
    }
    Vector predicted = Vector::Zero(N);
    for (Index k = steps; k < N; ++k) {
        Vector state = states[static_cast<std::size_t>(k - steps)];
        for (Index i = k - steps + 1; i < k; ++i) state = F * state + G * u[i];
        predicted[k] = state[0];
    }
    return predicted;
}

TEST(prediction, is_that_of_a_kalman_filter) {  // oracle: second route, once the filter is settled
    const Simulated s = simulated(kArmax, kArmaxTheta, 600);
    for (const InitialState state : {InitialState::kZero, InitialState::kEstimate, InitialState::kAuto})
        for (const Index k : {1, 3, 20}) {
            const Predictions all = predict(s.data(), noisy(s.model), ahead(k, state));
            const Vector filtered = kalman_predictions(s.model, s.u, s.y, k);
            EXPECT_LT((only(all).output - filtered).tail(400).cwiseAbs().maxCoeff(), 1e-9) << k;
        }
}

TEST(prediction, impulse_response_of_the_noise) {  // oracle: long division by hand
    // (1 + 0.5 q^-1)/((1 - 0.8 q^-1)(1 + 0.2 q^-1)) = 1 + 1.1 q^-1 + 0.82 q^-2 + 0.668 q^-3 ...
    PolynomialOrders orders = PolynomialOrders::arx(1, {1}, {1});
    orders.nc = orders.nd = 1;
    const NoisyModel model = noisy(PolynomialModel(orders, Vector{{-0.8, 2, 0.5, 0.2}}, 1));
    const Vector h = noise_impulse_response(model, 4);
    EXPECT_LT((h - Vector{{1, 1.1, 0.82, 0.668}}).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_TRUE(model.has_noise_model());
    EXPECT_FALSE(NoisyModel{}.has_noise_model());
}

// Oracle: the sum that the estimators minimize.
TEST(prediction, errors_of_a_models_own_record_are_its_loss) {
    const IdData data =
        IdData::merge({simulated(kArmax, kArmaxTheta, 500).data(), simulated(kArmax, kArmaxTheta, 300, 2).data()});
    const Fit linear = arx(data, PolynomialOrders::arx(2, {3}, {1})), full = armax(data, kArmax);
    for (const Fit& fit : {linear, full}) {
        const Predictions all = predict(data, noisy(fit));
        EXPECT_NEAR(all.loss[0], fit.loss, 1e-12);
        EXPECT_NEAR(all.fit_percent[0], fit.prediction_fit_percent, 1e-9);
        EXPECT_NEAR(predict(data, noisy(fit), {std::nullopt, {}}).fit_percent[0], fit.fit_percent[0], 1e-9);
    }
    EXPECT_EQ(predict(data, noisy(linear)).results[1][0].first, 3);
    const IdData other = simulated(kBoxJenkins, kBoxJenkinsTheta, 800, 3).data();
    for (const InitialState state : {InitialState::kZero, InitialState::kSteady, InitialState::kEstimate})
        for (const Offset offset : {Offset::kNone, Offset::kEstimate, Offset::kRemove}) {
            FitOptions options;
            options.initial_state = state;
            options.offset = offset;
            const Fit fit = bj(other, kBoxJenkins, options);
            EXPECT_NEAR(predict(other, noisy(fit), ahead(1, state, offset)).loss[0], fit.loss, 1e-10);
        }
}

TEST(prediction, many_steps_ahead_is_nearly_the_simulation) {  // oracle: what the noise model has forgotten by then
    const Simulated s = simulated(kArmax, kArmaxTheta, 4000);
    const Predictions many = predict(s.data(), noisy(s.model), ahead(3000));
    const Predictions run = predict(s.data(), noisy(s.model), ahead(std::nullopt));
    EXPECT_LT((only(many).output - run.results[0][0].output).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(prediction, of_continuous_models_with_noise) {  // oracle: the noise of the data; rivc's own variance
    const Index N = 900;
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 1.2, 4.0}}, 0, 0.13);
    Vector e = 0.3 * RandomStream(4).normal(N);
    e.head(1).setZero();
    const Vector C{{1, 0.5}}, D{{1, -0.9}}, u = random_levels(N, 12, 9);
    const Vector x = lsim(G, u, 0.05), y = x + divided_by(D, weighted_past(C, e));
    const IdData data(Matrix(y), Matrix(u), 0.05);
    NoisyModel model{{G}, nullptr, C, D, 0.05};
    for (const Index k : {1, 4}) {
        const Predictions all = predict(data, model, ahead(k));
        EXPECT_LT((only(all).errors - e).cwiseAbs().maxCoeff(), 1e-12);
        for (Index t = k + 1; t < 60; ++t) {
            Vector known = e;
            known.tail(N - t + k - 1).setZero();
            EXPECT_NEAR(only(all).output[t], x[t] + divided_by(D, weighted_past(C, known))[t], 1e-11);
        }
    }
    const IdData plain(Matrix(lsim(TransferFunction(G.num(), G.den()), u, 0.05) + y - x), Matrix(u), 0.05);
    const Fit fit = rivc(plain, TransferStructure::single(2, 0), {1, 1});
    const double squares = only(predict(plain, noisy(fit), ahead(1))).errors.squaredNorm();
    EXPECT_NEAR(squares / (N - 1 - 5), fit.noise_variance[0], 1e-10);
    EXPECT_GT(predict(plain, noisy(fit)).fit_percent[0], predict(plain, noisy(fit), ahead({})).fit_percent[0] + 10);
}

TEST(prediction, its_errors_are_tested_for_whiteness) {  // oracle: the true and a wrong structure of the data
    const IdData data = simulated(kArmax, kArmaxTheta, 3000, 7).data();
    const Fit right = armax(data, kArmax);
    PolynomialOrders lower_order = kArmax;
    lower_order.nc = 0;
    const ResidualTests good = prediction_error_tests(data, predict(data, noisy(right)));
    EXPECT_TRUE(good.outputs[0].whiteness.white) << message_text(good.verdict);
    EXPECT_TRUE(good.outputs[0].inputs[0].independent);
    EXPECT_THAT(message_text(good.verdict), HasSubstr("The prediction error is white"));
    EXPECT_EQ(good.residuals[0].col(0), predict(data, noisy(right)).results[0][0].errors);
    const ResidualTests poor = prediction_error_tests(data, predict(data, noisy(armax(data, lower_order))));
    EXPECT_THAT(message_text(poor.verdict), HasSubstr("The prediction error is not white"));
    const ResidualTests of_simulation = residual_tests(data, {right.polynomial->transfer_function()});
    EXPECT_THAT(message_text(of_simulation.verdict), HasSubstr("The output error is not white"));
    EXPECT_THAT(message_text(of_simulation.verdict), HasSubstr("a method with a noise model"));
}

TEST(prediction, without_a_noise_model_is_the_simulation) {  // oracle: second route, compare_all
    const IdData data = simulated(kBoxJenkins, kBoxJenkinsTheta, 400, 5).data();
    const Fit fit = oe(data, PolynomialOrders::output_error({2}, {2}, {1}));
    for (const std::optional<Index> k : {std::optional<Index>(1), std::optional<Index>(9), std::optional<Index>()}) {
        const Predictions all = predict(data, noisy(fit), {k, {}});
        const Comparison comparison = compare_all(data, {fit.polynomial->transfer_function()});
        EXPECT_EQ(only(all).output, comparison.results[0][0].output);
        EXPECT_NEAR(all.fit_percent[0], comparison.fit_percent[0], 1e-12);
        EXPECT_EQ(only(all).errors, data.experiments[0].y.col(0) - only(all).output);
        EXPECT_THAT(message_text(all.message), HasSubstr("Simulated "));
    }
}

TEST(prediction, finds_offset_and_operating_point) {  // oracle: the noise-free data, predicted without an error
    Simulated s = simulated(kBoxJenkins, kBoxJenkinsTheta, 400);
    s.y = model_output(s.model, s.u, Vector::Zero(400)).array() + 20;
    for (const Offset offset : {Offset::kEstimate, Offset::kAuto}) {
        const Predictions all = predict(s.data(), noisy(s.model), ahead(3, InitialState::kAuto, offset));
        EXPECT_LT(only(all).errors.cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_THAT(message_text(all.message), HasSubstr("Predicted 3 steps ahead"));
        EXPECT_THAT(message_text(all.message), HasSubstr("with an estimated offset"));
    }
    const IdData late = s.data().range(150, 400);
    EXPECT_LT(only(predict(late, noisy(s.model))).errors.cwiseAbs().maxCoeff(), 1e-9);
    const Simulated level = simulated(kArmax, kArmaxTheta, 400);
    const Vector y = model_output(level.model, level.u, Vector::Zero(400));
    const Vector u = level.u.array() + 3, raised = y.array() + 3 * level.model.transfer_function().dc_gain();
    const Predictions all = predict(IdData(Matrix(raised), Matrix(u), 0.5), noisy(level.model));
    EXPECT_LT(only(all).errors.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(prediction, operating_point_is_taken_off_and_put_back) {  // oracle: second route, data without their means
    const Simulated s = simulated(kArmax, kArmaxTheta, 500);
    const IdData raised(Matrix(s.y.array() + 20), Matrix(s.u.array() + 4), 0.5);
    const Vector y = s.y.array() - s.y.mean(), u = s.u.array() - s.u.mean();
    const Predictions removed = predict(raised, noisy(s.model), ahead(4, InitialState::kEstimate, Offset::kRemove));
    const Predictions own =
        predict(IdData(Matrix(y), Matrix(u), 0.5), noisy(s.model), ahead(4, InitialState::kEstimate, Offset::kNone));
    EXPECT_LT((only(removed).errors - only(own).errors).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((only(removed).output.array() - 20 - s.y.mean() - only(own).output.array()).abs().maxCoeff(), 1e-11);
}

TEST(prediction, takes_a_model_apart_and_together) {  // oracle: its own parameters
    PolynomialOrders orders = PolynomialOrders::output_error({2, 1}, {1, 2}, {3, 0});
    orders.na = orders.nc = orders.nd = 1;
    const Vector theta{{-0.5, 0.1, 4, 5, 0.2, 0.3, 6, 0.7, 0.8}};
    const OrderedParameters parts = ordered_parameters(PolynomialModel(orders, theta, 1));
    EXPECT_EQ(parts.theta, theta);
    EXPECT_EQ(parts.orders.parameter_names(), orders.parameter_names());
}

TEST(prediction, of_a_free_response_needs_no_input) {  // oracle: the definition with an input of zeros
    const Simulated s = simulated(kArmax, kArmaxTheta, 200);
    const Vector u = Vector::Zero(200), y = model_output(s.model, u, s.e);
    const Predictions all = predict(IdData(Matrix(y), Matrix(u), 0.5), noisy(s.model), ahead(1));
    EXPECT_LT((only(all).errors - s.e).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(prediction, refuses_what_it_cannot_predict) {  // oracle: definitions
    const Simulated s = simulated(kArmax, kArmaxTheta, 60);
    const auto refusal = [](const IdData& data, const NoisyModel& model, std::optional<Index> k = 1) {
        return thrown_message([&] { predict(data, model, {k, {}}); });
    };
    EXPECT_THAT(refusal(s.data(), noisy(s.model), 0), HasSubstr("at least 1 step"));
    EXPECT_THAT(refusal(IdData(Matrix(s.y), Matrix(s.u), 0.25), noisy(s.model)),
                HasSubstr("its noise is 0.5 s, but the sampling time of the data is 0.25 s"));
    EXPECT_THAT(refusal(IdData(Matrix(s.y), Matrix::Ones(60, 2), 0.5), noisy(s.model)),
                HasSubstr("The model has 1 input, but the data have 2"));
    EXPECT_THAT(refusal(IdData(Matrix::Ones(60, 1), Matrix(s.u), 0.5), noisy(s.model)),
                HasSubstr("The measured output never changes, so a relative fit is undefined"));
    EXPECT_THAT(refusal(s.data().range(1, 2), noisy(s.model)), HasSubstr("too few samples for a prediction"));
    Vector theta = kArmaxTheta;
    theta.tail(2) << -2.5, 1;
    EXPECT_THAT(refusal(s.data(), noisy(PolynomialModel(kArmax, theta, 0.5))),
                HasSubstr("C of the noise model has a root on or outside the unit circle"));
    const NoisyModel colored{{TransferFunction()}, nullptr, Vector{{1, 0.5}}, Vector::Ones(1), 1};
    EXPECT_THAT(refusal(s.data(), colored), HasSubstr("The sampling times must be equal"));
    EXPECT_THAT(
        refusal(IdData(Matrix(s.y), Matrix(s.u), Vector::LinSpaced(60, 0, 1).array().square().matrix()), colored),
        HasSubstr("sampled irregularly"));
}

}  // namespace test_prediction
