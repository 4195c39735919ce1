#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/compare.h"

namespace test_compare {

using namespace dynlab;

const TransferFunction kG(Vector{{2.0}}, Vector{{1.0, 1.2, 4.0}});

Vector rough_input(Index N, double mean) {
    const Vector noise = RandomStream(5).normal(N);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = mean + (noise[k / 20] > 0 ? 1 : -1);
    return u;
}

/// By its definition.
double fit_of(const Vector& y, const Vector& simulated) {
    return 100 * (1 - (y - simulated).norm() / (y.array() - y.mean()).matrix().norm());
}

IdData siso(const Vector& y, const Vector& u, double Ts) {
    return IdData(Matrix(y), Matrix(u), Ts);
}

TEST(compare, zero_state_is_plain_simulation) {  // oracle: second route, lsim
    const Vector u = rough_input(400, 0), y = lsim(kG, u, 0.05) + 0.1 * RandomStream(1).normal(400);
    const auto result = compare(siso(y, u, 0.05), kG, {InitialState::kZero, Offset::kNone});
    EXPECT_LT((result.output - lsim(kG, u, 0.05)).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_NEAR(result.fit_percent, fit_of(y, lsim(kG, u, 0.05)), 1e-12);
    EXPECT_EQ(result.offset, 0);
}

TEST(compare, automatic_choice_keeps_what_needs_nothing) {  // oracle: the simulated truth
    const Vector u = rough_input(400, 0), y = lsim(kG, u, 0.05) + 0.05 * RandomStream(1).normal(400);
    const auto result = compare(siso(y, u, 0.05), kG);
    EXPECT_EQ(result.start.state, InitialState::kZero);
    EXPECT_FALSE(result.start.offset);
}

TEST(compare, finds_initial_state_and_offset) {  // oracle: the simulated truth
    const Vector u = rough_input(600, 3);
    const Vector whole = lsim(kG, u, 0.05).array() - 7;
    const auto result = compare(siso(whole.tail(550), u.tail(550), 0.05), kG);
    EXPECT_EQ(result.start.state, InitialState::kEstimate);
    EXPECT_NEAR(result.fit_percent, 100, 1e-8);
    EXPECT_NEAR(result.offset, -7, 1e-9);
    EXPECT_EQ(result.initial_values.size(), 2);
    EXPECT_LT((result.output - whole.tail(550)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(compare, steady_start_of_a_step_experiment) {  // oracle: analytic
    const Index N = 300;
    Vector u = Vector::Constant(N, 30), y(N);
    u.tail(N - 50).setConstant(50);
    for (Index k = 0; k < N; ++k)
        y[k] = 18 + 0.5 * 30 + 0.5 * 20 * (k < 50 ? 0 : -std::expm1(-static_cast<double>(k - 50) * 2 / 70.0));
    const TransferFunction G(Vector{{0.5}}, Vector{{70.0, 1.0}});
    const auto result = compare(siso(y, u, 2), G);
    EXPECT_EQ(result.start.state, InitialState::kSteady);
    EXPECT_NEAR(result.offset, 18, 1e-9);
    EXPECT_NEAR(result.fit_percent, 100, 1e-8);
    const auto removed = compare(siso(y, u, 2), G, {InitialState::kZero, Offset::kRemove});
    EXPECT_NEAR(removed.offset, 33, 1e-12);
    EXPECT_NEAR(removed.fit_percent, 100, 1e-8);
    EXPECT_LT((removed.output - y).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(compare, a_wrong_gain_cannot_hide) {  // justified: with a constant input, free motion and offset could mimic it
    const Vector u = Vector::Ones(300), y = lsim(kG, u, 0.05);
    const TransferFunction wrong(Vector{{3.0}}, kG.den());
    EXPECT_GT(compare(siso(y, u, 0.05), kG).fit_percent, 99.999);
    EXPECT_LT(compare(siso(y, u, 0.05), wrong).fit_percent, 60);
}

TEST(compare, takes_discrete_models_and_irregular_data) {  // oracle: second route, lsim
    const Vector u = rough_input(200, 0);
    const TransferFunction discrete(Vector{{0.5}}, Vector{{1.0, -0.8}}, 0.05);
    const Vector y = lsim(discrete, u, 0.05);
    EXPECT_NEAR(compare(siso(y, u, 0.05), discrete).fit_percent, 100, 1e-9);
    Vector t(200);
    RandomStream random(2);
    t[0] = 0;
    for (Index k = 1; k < 200; ++k) t[k] = t[k - 1] + 0.02 + 0.05 * random.uniform();
    const Vector late = lsim(kG, u, t, Hold::kZoh);
    EXPECT_NEAR(compare(IdData(Matrix(late), Matrix(u), t), kG).fit_percent, 100, 1e-8);
}

// The output from the first input on, with the free motion and the offset that least squares over every sample finds.
Vector fitted_by_definition(const Vector& y, const Vector& u, const TransferFunction& G, double Ts) {
    const Index N = y.size(), n = G.pole_count();
    const Vector steady = (lsim(G, u.array() - u[0], Ts).array() + G.dc_gain() * u[0]).matrix();
    Matrix regressors = Matrix::Ones(N, n + 1);
    for (Index i = 0; i < n; ++i)
        regressors.col(i) =
            lsim(TransferFunction(Vector::Ones(1), G.den()), Vector::Zero(N), Ts, Hold::kZoh, Vector::Unit(n, i));
    return steady + regressors * solve_least_squares(regressors, y - steady).solution;
}

TEST(compare, long_records_need_their_beginning_only) {  // oracle: least squares over every sample
    const Vector u = rough_input(20000, 2);
    const TransferFunction late(Vector{{2.0}}, kG.den(), 0, 111), slow(Vector{{1.0}}, Vector{{1.0, 0.0001}}),
        undamped(Vector{{1.0}}, Vector{{1.0, 0.0, 1.0}});
    for (const TransferFunction& G : {kG, late, slow, undamped}) {
        const Vector y = lsim(G, u, 0.05).array() + 4 + 0.1 * RandomStream(3).normal(20000).array();
        const Vector cut = y.tail(19000), input = u.tail(19000);
        const auto result = compare(siso(cut, input, 0.05), G, {InitialState::kEstimate, Offset::kEstimate});
        const Vector expected = fitted_by_definition(cut, input, G, 0.05);
        EXPECT_LT((result.output - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff());
        EXPECT_NEAR(result.fit_percent, fit_of(cut, expected), 1e-7);
    }
}

TEST(compare, an_unstable_model_is_an_answer_too) {  // oracle: it fits worse than the mean, and nothing is thrown
    const Vector u = rough_input(2000, 0), y = lsim(kG, u, 0.5);
    const TransferFunction wild(Vector{{1.0}}, Vector{{1.0, -2.0}});
    EXPECT_FALSE(compare(siso(y, u, 0.5), wild).fit_percent > 0);
}

TEST(compare, refuses_other_data) {
    const IdData two(Matrix::Random(20, 1), Matrix::Random(20, 2), 1.0);
    EXPECT_THROW(compare(two, kG), InvalidArgument);
    EXPECT_THROW(compare(siso(Vector::Ones(20), rough_input(20, 0), 1), kG), InvalidArgument);
}

TEST(compare, experiments_and_channels_are_compared_each_by_itself) {  // oracle: the simulated truth
    const TransferFunction slow(Vector{{1.0}}, Vector{{1.0, 0.5}});
    const std::vector<TransferFunction> model = {kG, slow, slow, kG};
    std::vector<IdData> parts;
    for (const Index N : {500, 300}) {
        Matrix u(N, 2), y(N, 2);
        u << rough_input(N, 1), RandomStream(2).normal(N);
        y.col(0) = lsim(kG, u.col(0), 0.05) + lsim(slow, u.col(1), 0.05);
        y.col(1) = (lsim(slow, u.col(0), 0.05) + lsim(kG, u.col(1), 0.05)).array() + 4;
        parts.push_back(IdData(y, u, 0.05).range(101, N));  // the first samples are cut off
    }
    const IdData data = IdData::merge(parts);
    const Comparison all = compare_all(data, model);
    ASSERT_EQ(all.results.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LT((all.outputs(k) - data.experiments[k].y).cwiseAbs().maxCoeff(), 1e-8);
        EXPECT_EQ(all.results[k][0].start.state, InitialState::kEstimate);
        EXPECT_EQ(all.results[k][0].initial_values.size(), 3);  // two states of kG, one of the slow channel
        EXPECT_NEAR(all.results[k][1].offset, 4, 1e-7);
    }
    EXPECT_NEAR(all.fit_percent.minCoeff(), 100, 1e-6);
    EXPECT_THROW(compare_all(data, {kG, slow}), InvalidArgument);
}

TEST(compare, fit_over_experiments_is_that_of_all_squares_together) {  // oracle: the definition
    const Vector u = rough_input(400, 0), y = lsim(kG, u, 0.05) + 0.2 * RandomStream(1).normal(400);
    const IdData whole = siso(y, u, 0.05), data = IdData::merge({whole.range(1, 150), whole.range(151, 400)});
    const Comparison all = compare_all(data, {kG});
    double squares = 0, variation = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const Vector measured = data.experiments[k].y.col(0);
        squares += (measured - all.results[k][0].output).squaredNorm();
        variation += (measured.array() - measured.mean()).matrix().squaredNorm();
    }
    EXPECT_NEAR(all.fit_percent[0], 100 * (1 - std::sqrt(squares / variation)), 1e-10);
}

}  // namespace test_compare
