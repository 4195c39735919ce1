#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/criteria/discrete_output.h"
#include "numerics/estimators/oe.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_oe {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

struct Case {
    PolynomialOrders orders;
    Vector theta;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> kCases = {
        {PolynomialOrders::output_error({1}, {1}, {1}), Vector{{-0.9, 0.3}}},
        {PolynomialOrders::output_error({2}, {2}, {1}), Vector{{-1.5, 0.7, 1, 0.5}}},
        {PolynomialOrders::output_error({2}, {2}, {1}), Vector{{-1.98, 0.9805, 1e-3, -0.9e-3}}},
        {PolynomialOrders::output_error({1}, {3}, {4}), Vector{{-1.6, 1.1, -0.3, 2}}},
        {PolynomialOrders::output_error({3}, {0}, {0}), Vector{{1, -2, 0.5}}},
        {PolynomialOrders::output_error({2, 1}, {2, 1}, {1, 2}), Vector{{-1.5, 0.7, 1, 0.5, -0.8, -3}}},
    };
    return kCases;
}

Matrix inputs(Index N, std::size_t count, std::uint32_t seed) {
    Matrix u(N, static_cast<Index>(count));
    for (Index i = 0; i < u.cols(); ++i)
        u.col(i) = random_levels(N, 4 + i, seed + 17 * static_cast<std::uint32_t>(i)).array() + 0.3;
    return u;
}

IdData simulated(const Case& c, Index N, double noise, std::uint32_t seed) {
    const Matrix u = inputs(N, c.orders.inputs(), seed);
    const Vector x = model_output(PolynomialModel(c.orders, c.theta, 0.1), u, Vector::Zero(N));
    return IdData(Matrix(x + noise * RandomStream(seed).normal(N)), u, 0.1);
}

FitOptions tight() {
    FitOptions options;
    options.tolerance = 1e-10;
    return options;
}

double worst_relative(const Vector& a, const Vector& truth) {
    return (a - truth).cwiseQuotient(truth).cwiseAbs().maxCoeff();
}

TEST(oe, recovers_noise_free_systems) {  // oracle: the simulated system
    for (const Case& c : cases()) {
        const auto result = oe(simulated(c, 800, 0, 1), c.orders, tight());
        EXPECT_LT(worst_relative(result.theta, c.theta), 1e-8) << message_text(result.full_message());
        EXPECT_GT(result.fit_percent[0], 100 - 1e-6);
    }
}

TEST(oe, errors_are_orthogonal_to_the_sensitivities) {  // oracle: the definition of a minimum
    for (const Case& c : cases()) {
        const IdData data = simulated(c, 800, 0.3, 2);
        const auto result = oe(data, c.orders, tight());
        const Experiment& experiment = data.experiments[0];
        const std::vector<SampledExperiment> list{{experiment.u, experiment.y.col(0)}};
        const DiscreteOutput model(c.orders, {InitialState::kZero, false}, list);
        Vector output;
        Matrix J;
        model.simulate(result.theta, output, &J);
        const Vector error = list[0].y - output;
        for (Index i = 0; i < J.cols(); ++i)
            EXPECT_LT(std::abs(J.col(i).dot(error)), 1e-7 * J.col(i).norm() * error.norm())
                << message_text(result.full_message());
        EXPECT_NEAR(result.loss, error.squaredNorm() / 800, 1e-10);
        EXPECT_NEAR(result.noise_variance[0], error.squaredNorm() / static_cast<double>(800 - J.cols()), 1e-10);
        EXPECT_EQ(result.termination, Termination::kConverged) << message_text(result.full_message());
    }
}

TEST(oe, a_record_cut_from_a_running_experiment) {  // oracle: the simulated system
    for (const Case& c : cases()) {
        const IdData whole = simulated(c, 900, 0, 3);
        IdData data = whole.range(101, 900);
        data.experiments[0].y.array() += 7;
        FitOptions options = tight();
        options.initial_state = InitialState::kEstimate;
        options.offset = Offset::kEstimate;
        const auto result = oe(data, c.orders, options);
        EXPECT_LT(worst_relative(result.theta, c.theta), 1e-6) << message_text(result.full_message());
        EXPECT_NEAR(result.offsets(0, 0), 7, 1e-6);
        options.initial_state = InitialState::kAuto;
        options.offset = Offset::kAuto;
        const auto chosen = oe(data, c.orders, options);
        EXPECT_TRUE(chosen.start.offset);
        EXPECT_LT(worst_relative(chosen.theta, c.theta), 1e-6) << message_text(chosen.full_message());
        if (c.orders.past() > 1) {
            EXPECT_EQ(chosen.start.state, InitialState::kEstimate) << message_text(chosen.full_message());
        }
    }
}

TEST(oe, operating_point_is_removed) {  // oracle: the same data without it
    const Case& c = cases()[1];
    IdData data = simulated(c, 500, 0.1, 1);
    Experiment& experiment = data.experiments[0];
    experiment.u.array() -= experiment.u.mean();
    experiment.y.array() -= experiment.y.mean();
    FitOptions options = tight().from_rest();
    const auto centered = oe(data, c.orders, options);
    experiment.u.array() += 5;
    experiment.y.array() += 40;
    options.offset = Offset::kRemove;
    const auto result = oe(data, c.orders, options);
    EXPECT_LT(worst_relative(result.theta, centered.theta), 1e-8);
    EXPECT_NEAR(result.offsets(0, 0), 40, 1e-9);
}

TEST(oe, experiments_count_together_in_any_order) {  // oracle: invariance
    for (const Case& c : {cases()[1], cases()[5]}) {
        const IdData a = simulated(c, 300, 0.3, 1), b = simulated(c, 500, 0.3, 2);
        FitOptions options = tight();
        options.initial_state = InitialState::kEstimate;
        const auto ab = oe(IdData::merge({a, b}), c.orders, options), ba = oe(IdData::merge({b, a}), c.orders, options);
        EXPECT_LT(worst_relative(ab.theta, ba.theta), 1e-8);
        EXPECT_LT(worst_relative(ab.std, ba.std), 1e-7);
        EXPECT_NEAR(ab.fit_percent[0], ba.fit_percent[0], 1e-8);
        const auto alone = oe(a, c.orders, options);
        EXPECT_LT(ab.std[0], alone.std[0]);
    }
}

TEST(oe, a_step_is_enough) {  // oracle: the simulated system
    const Case& c = cases()[1];
    const Matrix u = Matrix::Ones(100, 1);
    const Vector y = model_output(PolynomialModel(c.orders, c.theta, 0.1), u, Vector::Zero(100));
    const auto result = oe(IdData(Matrix(y), u, 0.1), c.orders, tight());
    EXPECT_LT(worst_relative(result.theta, c.theta), 1e-8) << message_text(result.full_message());
}

TEST(oe, doubtful_results_come_with_a_sentence) {  // oracle: the simulated system
    const Case& c = cases()[1];
    FitOptions hurried;
    hurried.max_iterations = 1;
    hurried.tolerance = 1e-14;
    const auto result = oe(simulated(c, 300, 0.5, 1), c.orders, hurried);
    EXPECT_EQ(result.termination, Termination::kIterationLimit);
    EXPECT_THAT(message_text(result.full_message()), HasSubstr("`max_iterations` = 1"));
    EXPECT_GT(result.fit_percent[0], 0);
    const Matrix noise = RandomStream(8).normal(300);
    EXPECT_THAT(
        message_text(
            oe(IdData(noise, inputs(300, 1, 1), 1), PolynomialOrders::output_error({5}, {0}, {1})).full_message()),
        HasSubstr("do not reliably determine"));
    const auto high = oe(simulated(c, 300, 0, 1), PolynomialOrders::output_error({3}, {3}, {1}));
    EXPECT_THAT(message_text(high.full_message()), HasSubstr("do not determine all parameters separately"));
    EXPECT_GT(high.fit_percent[0], 99.99);
}

TEST(oe, can_be_canceled) {  // oracle: definition
    FitOptions options;
    int asked = 0;
    options.cancel = [&] { return ++asked > 3; };
    const auto result = oe(simulated(cases()[1], 300, 0.1, 1), cases()[1].orders, options);
    EXPECT_EQ(result.termination, Termination::kCanceled);
    EXPECT_TRUE(result.theta.allFinite());
}

TEST(oe, refuses_what_it_cannot_fit) {
    const Case& c = cases()[1];
    const IdData data = simulated(c, 100, 0.1, 1);
    const Matrix u = data.experiments[0].u, y = data.experiments[0].y;
    const auto refusal = [&](const IdData& given, const FitOptions& options = {}) {
        return thrown_message([&] { oe(given, c.orders, options); });
    };
    EXPECT_THAT(refusal(IdData(y, Matrix::Zero(100, 1), 1)), HasSubstr("oe: the input u1 is zero"));
    EXPECT_THAT(refusal(IdData(Matrix::Ones(100, 1), u, 1)), HasSubstr("never changes"));
    EXPECT_THAT(refusal(IdData(y, Matrix::Random(100, 2), 1)), HasSubstr("2 inputs"));
    EXPECT_THAT(refusal(IdData(Matrix::Random(100, 2), u, 1)), HasSubstr("one output"));
    EXPECT_THAT(refusal(IdData(y, u, Vector::LinSpaced(100, 0, 1))), HasSubstr("regularly"));
    EXPECT_THAT(refusal(data.range(1, 4)),
                HasSubstr("oe estimates 4 values and needs more samples than that, but the data have 4"));
    EXPECT_EQ(refusal(data.range(1, 20)), "");
    FitOptions options;
    options.tolerance = 0;
    EXPECT_THAT(refusal(data, options), HasSubstr("`tolerance`"));
    options = {};
    options.max_iterations = -1;
    EXPECT_THAT(refusal(data, options), HasSubstr("`max_iterations`"));
    EXPECT_THAT(thrown_message([&] { oe(data, PolynomialOrders::arx(2, {1}, {1})); }), HasSubstr("na, nc and nd"));
}

}  // namespace test_oe
