#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/bj.h"
#include "numerics/estimators/oe.h"
#include "numerics/fit/assessment.h"
#include "numerics/fit/discrete/prediction_model.h"
#include "numerics/fit/output_error.h"
#include "support/difference_equation.h"
#include "support/thrown_message.h"

namespace test_bj {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

PolynomialOrders orders_of(int nc, int nd) {
    PolynomialOrders orders = PolynomialOrders::output_error({2}, {2}, {1});
    orders.nc = nc;
    orders.nd = nd;
    return orders;
}

const PolynomialOrders kOrders = orders_of(1, 1);
const Vector kTheta{{-1.5, 0.7, 1, 0.5, 0.5, -0.9}};

IdData simulated_data(Index N, double noise, std::uint32_t seed, Index cut = 0) {
    const Vector u = random_levels(N, 2, seed + 1000), e = noise * RandomStream(seed).normal(N);
    const Vector y = model_output(PolynomialModel(kOrders, kTheta, 1), u, e);
    return IdData(Matrix(y.tail(N - cut)), Matrix(u.tail(N - cut)), 1);
}

FitOptions tight(InitialState state = InitialState::kZero, Offset offset = Offset::kNone) {
    FitOptions options;
    options.tolerance = 1e-10;
    options.max_iterations = 200;
    options.initial_state = state;
    options.offset = offset;
    return options;
}

/// Mean square of e by the definition, from zero state, without the first sample.
double loss_of(const IdData& data, const Vector& theta) {
    const PolynomialModel model(kOrders, theta, 1);
    const Vector y = data.experiments[0].y, u = data.experiments[0].u;
    const Vector v = y - divided_by(model.F[0], weighted_past(model.B[0], u));
    Vector w = weighted_past(model.D, v);
    w[0] = 0;
    return divided_by(model.C, w).squaredNorm() / static_cast<double>(y.size() - 1);
}

TEST(bj, recovers_noise_free_systems) {  // oracle: the simulated system
    const auto result = bj(simulated_data(500, 0, 1), kOrders, tight());
    EXPECT_LT((result.theta - kTheta).head(4).cwiseAbs().maxCoeff(), 1e-8) << message_text(result.full_message());
}

TEST(bj, without_c_and_d_it_is_oe) {  // oracle: oe, whose search is another program path
    IdData data = IdData::merge({simulated_data(600, 0.5, 1, 50), simulated_data(400, 0.5, 2, 50)});
    for (Experiment& experiment : data.experiments) experiment.y.array() += 3;
    for (const InitialState state : {InitialState::kZero, InitialState::kEstimate, InitialState::kAuto})
        for (const Offset offset : {Offset::kNone, Offset::kEstimate, Offset::kRemove}) {
            const auto expected = oe(data, orders_of(0, 0), tight(state, offset));
            const auto result = bj(data, orders_of(0, 0), tight(state, offset));
            EXPECT_LT((result.theta - expected.theta).cwiseAbs().maxCoeff(), 1e-7);
            EXPECT_LT((result.std - expected.std).cwiseAbs().maxCoeff(), 1e-6);
            EXPECT_LT((result.offsets - expected.offsets).cwiseAbs().maxCoeff(), 1e-6);
            EXPECT_NEAR(result.fit_percent[0], expected.fit_percent[0], 1e-6);
        }
}

TEST(bj, gradient_is_zero_at_the_optimum) {  // oracle: central differences of the definition's loss
    const IdData data = simulated_data(800, 0.3, 3);
    const auto result = bj(data, kOrders, tight());
    EXPECT_NEAR(result.loss, loss_of(data, result.theta), 1e-10);
    for (Index i = 0; i < kTheta.size(); ++i) {
        const Vector step = 1e-5 * Vector::Unit(kTheta.size(), i);
        const double slope = (loss_of(data, result.theta + step) - loss_of(data, result.theta - step)) / 2e-5;
        EXPECT_LT(std::abs(slope), 1e-5 * result.loss) << i;
        EXPECT_GT(loss_of(data, result.theta + 10 * step), result.loss);
    }
    EXPECT_EQ(result.termination, Termination::kConverged) << message_text(result.full_message());
}

// Oracle: statistics with fixed seeds; the covariance of the maximum-likelihood estimate is the Cramer-Rao bound.
TEST(bj, scatters_as_its_standard_errors_say_and_less_than_oe) {
    constexpr Index kRuns = 150;
    Matrix thetas(6, kRuns), errors(6, kRuns), others(4, kRuns);
    for (Index run = 0; run < kRuns; ++run) {
        const IdData data = simulated_data(800, 0.3, static_cast<std::uint32_t>(run + 1));
        const auto result = bj(data, kOrders);
        thetas.col(run) = result.theta;
        errors.col(run) = result.std;
        others.col(run) = oe(data, orders_of(0, 0)).theta;
    }
    const auto spread = [](const auto& row) {
        return std::sqrt((row.array() - row.mean()).square().sum() / (kRuns - 1));
    };
    for (Index i = 0; i < 6; ++i) {
        const double own = spread(thetas.row(i));
        EXPECT_NEAR(own / errors.row(i).mean(), 1, 0.2) << i;
        EXPECT_NEAR(thetas.row(i).mean(), kTheta[i], 3.5 * own / std::sqrt(double(kRuns)) + 0.1 * own) << i;
        if (i < 4) {
            EXPECT_LT(own, 0.7 * spread(others.row(i))) << i;
        }
    }
}

/// Oracle: the search over all samples from the truth. The input of the second data set is silent in its first quarter,
/// which carries no information. The noise of the third data set is thirty times larger there.
TEST(bj, long_records_end_where_the_search_from_the_truth_ends) {
    constexpr Index kLong = 420000, kQuarter = kLong / 4;
    for (const char* kind : {"even", "silent", "noisy"}) {
        Vector u = random_levels(kLong, 2, 7), e = 0.5 * RandomStream(3).normal(kLong);
        if (kind == std::string("silent")) u.head(kQuarter).setZero();
        if (kind == std::string("noisy")) e.head(kQuarter) *= 30;
        const IdData data(Matrix(model_output(PolynomialModel(kOrders, kTheta, 1), u, e)), Matrix(u), 1);
        const Fit found = bj(data, kOrders, tight());
        const std::vector<SampledExperiment> experiments{{data.experiments[0].u, data.experiments[0].y.col(0)}};
        const PredictionModel model(kOrders, {InitialState::kZero, false}, experiments);
        const Fit best =
            minimize_output_error(model, model.target(), model.completed(kTheta), FitOptions{}.limited(200, 1e-10));
        EXPECT_LT((found.theta - best.theta.head(kTheta.size())).cwiseAbs().maxCoeff(), 1e-7) << kind;
    }
}

TEST(bj, a_record_cut_from_a_running_experiment) {  // oracle: the simulated system
    IdData data = simulated_data(2000, 0.05, 4, 100);
    data.experiments[0].y.array() += 7;
    const auto result = bj(data, kOrders, tight(InitialState::kAuto, Offset::kAuto));
    for (Index i = 0; i < kTheta.size(); ++i) EXPECT_NEAR(result.theta[i], kTheta[i], 4 * result.std[i]) << i;
    EXPECT_TRUE(result.start.offset);
    EXPECT_NEAR(result.offsets(0, 0), 7, 0.3);
}

TEST(bj, prediction_errors_are_tested_for_whiteness) {  // oracle: statistics with a fixed seed
    const IdData data = simulated_data(2000, 0.3, 5);
    EXPECT_TRUE(assess(data, bj(data, kOrders)).white);
    EXPECT_FALSE(assess(data, bj(data, orders_of(0, 0))).white);
}

TEST(bj, refuses_what_it_cannot_fit) {  // oracle: definitions
    PolynomialOrders other = kOrders;
    other.na = 1;
    EXPECT_THAT(thrown_message([&] { bj(simulated_data(100, 0.1, 1), other); }), HasSubstr("na must be zero"));
    EXPECT_THAT(thrown_message([&] { bj(simulated_data(4, 0.1, 1), kOrders); }),
                HasSubstr("and needs more samples than that"));
}

}  // namespace test_bj
