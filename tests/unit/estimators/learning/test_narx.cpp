#include "numerics/estimators/learning/narx.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/estimators/arx.h"
#include "numerics/models/polynomial_model.h"
#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace test_narx {

using namespace dynlab;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr double kSampling = 0.5;

/// y(k) = 0.5 y(k-1) + 0.8 u(k-2) + u(k-1)^2 - 0.05 y(k-2)^2 - 0.5 + e, the equation of Chen and Billings' first
/// example.
IdData simulated_data(Index N, double noise, std::uint32_t seed) {
    RandomStream chance(seed);
    const Vector u = chance.uniform(N).array() * 2 - 1, e = noise * chance.normal(N);
    Vector y = Vector::Zero(N);
    for (Index k = 2; k < N; ++k)
        y[k] = 0.5 * y[k - 1] + 0.8 * u[k - 2] + u[k - 1] * u[k - 1] - 0.05 * y[k - 2] * y[k - 2] - 0.5 + e[k];
    return IdData(Matrix(y), Matrix(u), kSampling);
}

const NarxLags kLags{2, {2}, {1}};

double value_of(const NarxFit& found, const std::string& name) {
    for (std::size_t i = 0; i < found.fit.names.size(); ++i)
        if (found.fit.names[i] == name) return found.fit.theta[static_cast<Index>(i)];
    return std::nan("");
}

TEST(narx, finds_the_equation_of_a_clean_record) {  // oracle: the equation put in
    const NarxFit found = narx(simulated_data(300, 0, 1), kLags);
    EXPECT_THAT(found.fit.names, UnorderedElementsAre("1", "y1(k-1)", "u1(k-2)", "u1(k-1)^2", "y1(k-2)^2"));
    EXPECT_NEAR(value_of(found, "y1(k-1)"), 0.5, 1e-10);
    EXPECT_NEAR(value_of(found, "u1(k-2)"), 0.8, 1e-10);
    EXPECT_NEAR(value_of(found, "u1(k-1)^2"), 1, 1e-10);
    EXPECT_NEAR(value_of(found, "y1(k-2)^2"), -0.05, 1e-10);
    EXPECT_NEAR(value_of(found, "1"), -0.5, 1e-10);
    EXPECT_GT(found.fit.fit_percent[0], 99.9999);
    EXPECT_TRUE(found.fit.warnings.empty()) << message_text(found.fit.full_message());
}

TEST(narx, of_degree_one_is_arx) {  // oracle: arx, without a constant in the data
    IdData data = simulated_data(400, 0.1, 3);
    NarxOptions all{1, 5};
    const NarxFit found = narx(data, kLags, all);
    Experiment& experiment = data.experiments[0];
    // the constant as a second input that is one
    Matrix u(experiment.u.rows(), 2);
    u << experiment.u, Vector::Ones(experiment.u.rows());
    const Fit linear = arx(IdData(experiment.y, u, kSampling), PolynomialOrders::arx(2, {2, 1}, {1, 0}));
    EXPECT_NEAR(value_of(found, "y1(k-1)"), -linear.theta[0], 1e-9);
    EXPECT_NEAR(value_of(found, "y1(k-2)"), -linear.theta[1], 1e-9);
    EXPECT_NEAR(value_of(found, "u1(k-1)"), linear.theta[2], 1e-9);
    EXPECT_NEAR(value_of(found, "u1(k-2)"), linear.theta[3], 1e-9);
    EXPECT_NEAR(value_of(found, "1"), linear.theta[4], 1e-9);
}

TEST(narx, reports_the_errors_it_has) {  // oracle: statistics over 200 seeds
    const int runs = 200;
    Vector errors(runs);
    double stated = 0;
    NarxOptions five{2, 5};
    for (int run = 0; run < runs; ++run) {
        const NarxFit found = narx(simulated_data(300, 0.1, static_cast<std::uint32_t>(run + 1)), kLags, five);
        errors[run] = value_of(found, "u1(k-1)^2") - 1;
        for (std::size_t i = 0; i < found.fit.names.size(); ++i)
            if (found.fit.names[i] == "u1(k-1)^2") stated += found.fit.std[static_cast<Index>(i)] / runs;
    }
    const double scatter = std::sqrt(errors.squaredNorm() / runs);
    EXPECT_NEAR(scatter / stated, 1, 0.15);
    EXPECT_LT(std::abs(errors.mean()), 3 * scatter / std::sqrt(runs));
}

TEST(narx, takes_the_terms_that_reduce_most) {  // oracle: shares add up to what is explained
    const NarxFit found = narx(simulated_data(500, 0.05, 2), kLags, {2, 4});
    ASSERT_EQ(found.steps.size(), 4u);
    double explained = 0;
    for (const NarxStep& step : found.steps) explained += step.error_reduction;
    const IdData data = simulated_data(500, 0.05, 2);
    const double power = data.experiments[0].y.bottomRows(498).squaredNorm();
    EXPECT_NEAR(explained, 1 - found.fit.loss * 498 / power, 1e-10);
}

TEST(narx, runs_from_given_outputs) {  // oracle: the recursion written out
    const NarxFit found = narx(simulated_data(300, 0, 1), kLags);
    const Matrix u = Matrix::Constant(6, 1, 0.25);
    const FreeRun run = found.model->free_run(inputs_alone(u, kSampling, Hold::kZoh), 0, Vector{{0.4, -0.3}});
    Vector y(6);
    y.head(2) << 0.4, -0.3;
    for (Index k = 2; k < 6; ++k) y[k] = 0.5 * y[k - 1] + 0.2 + 0.0625 - 0.05 * y[k - 2] * y[k - 2] - 0.5;
    EXPECT_LT((run.output.col(0) - y).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_FALSE(run.lost_at.has_value());
}

TEST(narx, reports_when_a_run_is_lost) {  // oracle: y(k) = 1.5 y(k-1) + u grows by 1.5 a sample
    Vector y = Vector::Zero(40), u = RandomStream(4).normal(40);
    for (Index k = 1; k < 40; ++k) y[k] = (k < 20 ? 1.5 : -0.2) * y[k - 1] + u[k - 1];
    const IdData growing = IdData(Matrix(y), Matrix(u), 0.1).range(1, 20);
    const NarxFit found = narx(growing, {1, {1}, {1}}, {1, 2});
    const FreeRun run = found.model->free_run(inputs_alone(Matrix::Ones(100, 1), 0.1, Hold::kZoh), 0, Vector::Ones(1));
    ASSERT_TRUE(run.lost_at.has_value());
    double x = 1;
    Index k = 0;
    const double bound = 1e3 * growing.experiments[0].y.cwiseAbs().maxCoeff();
    while (std::abs(x) <= bound) x = 1.5 * x + 1, ++k;
    EXPECT_EQ(*run.lost_at, k);
    EXPECT_TRUE(run.output.bottomRows(100 - k).array().isNaN().all());
    EXPECT_THAT(message_text(divergence_text(inputs_alone(Matrix::Ones(100, 1), 0.1, Hold::kZoh), 0, 32)),
                HasSubstr("t = 3.2 s"));
}

TEST(narx, joins_experiments_and_inputs) {  // oracle: the equation put in
    const IdData one = simulated_data(150, 0, 5), two = simulated_data(150, 0, 6);
    const NarxFit found = narx(IdData::merge({one, two}), kLags);
    EXPECT_NEAR(value_of(found, "u1(k-1)^2"), 1, 1e-10);
    Matrix u(300, 2);
    const IdData data = simulated_data(300, 0, 7);
    u << RandomStream(9).normal(300), data.experiments[0].u;
    const NarxFit other = narx(IdData(data.experiments[0].y, u, kSampling), {2, {1, 2}, {1, 1}});
    EXPECT_NEAR(value_of(other, "u2(k-1)^2"), 1, 1e-10);
    EXPECT_TRUE(std::isnan(value_of(other, "u1(k-1)")));
}

TEST(narx, refuses_what_cannot_be_fitted) {
    const IdData data = simulated_data(50, 0, 1);
    EXPECT_THAT(thrown_message([&] { narx(data, {0, {0}, {1}}); }), HasSubstr("uses no past value"));
    EXPECT_THAT(thrown_message([&] { narx(data, {-1, {1}, {1}}); }), HasSubstr("must be nonnegative"));
    EXPECT_THAT(thrown_message([&] { narx(data, {1, {1, 1}, {1, 1}}); }), HasSubstr("for 2 inputs"));
    EXPECT_THAT(thrown_message([&] {
                    narx(data, kLags, {2, 16});
                }),
                HasSubstr("the lags and the degree allow only 15 candidates"));
    EXPECT_THAT(thrown_message([&] {
                    narx(data, {49, {1}, {1}}, {1, 0});
                }),
                HasSubstr("all required past values is 1,"));
    EXPECT_THAT(thrown_message([&] {
                    narx(data, {60, {1}, {1}}, {1, 0});
                }),
                AllOf(HasSubstr("all required past values is 0,"), HasSubstr("or set {na, nb, nk} = {23, 1, 1}")));
    EXPECT_THAT(thrown_message([&] { narx(data, kLags, {2, -1}); }), HasSubstr("`terms`"));
    EXPECT_THAT(thrown_message([&] {
                    narx(data, kLags, {4, 0});
                }),
                HasSubstr("48 samples have all required past values, which is too few for 70 candidate terms. Use at "
                          "least 23 more samples, or set `degree` = 3 or {na, nb, nk} = {1, 1, 1}"));
    EXPECT_THAT(thrown_message([&] { narx(data, kLags, {2, 0, [] { return true; }}); }), HasSubstr("interrupted"));
    const NarxFit found = narx(data, kLags);
    IdData faster = data;
    faster.Ts = 0.1;
    EXPECT_THAT(thrown_message([&] { found.model->free_run(faster, 0, Vector()); }),
                HasSubstr("the sampling time of the model is 0.5 s"));
    EXPECT_THAT(thrown_message([&] { found.model->free_run(data, 0, Vector::Ones(3)); }),
                HasSubstr("x0 must contain the first 2"));
    const IdData two(Matrix::Random(50, 2), Matrix::Random(50, 1), 1);
    EXPECT_THAT(thrown_message([&] { narx(two, kLags); }), HasSubstr("needs one output"));
}

TEST(narx, structures_that_the_message_for_few_samples_advises_can_be_estimated) {
    const IdData whole = simulated_data(40, 0.1, 2);
    for (Index N = 8; N <= 40; ++N) {
        const IdData data = whole.range(1, N);
        const std::string message = thrown_message([&] { narx(data, {3, {3}, {1}}); });
        if (message.empty()) continue;
        const bool degree = message.find("`degree` = 1") != std::string::npos;
        if (degree) narx(data, {3, {3}, {1}}, {1, 0});
        for (const int limit : {1, 2})
            if (message.find("{na, nb, nk} = {" + std::to_string(limit)) != std::string::npos)
                narx(data, {limit, {limit}, {1}});
        EXPECT_EQ(degree, N - 3 > 7) << message;
        EXPECT_EQ(message.find("{na, nb, nk} =") != std::string::npos, N - 1 > 6) << message;
    }
}

}  // namespace test_narx
