#include "numerics/estimators/learning/dmdc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "numerics/models/convert.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/thrown_message.h"

namespace test_dmdc {

using namespace dynlab;
using testing::HasSubstr;

StateSpace system_of_three() {
    return StateSpace(Matrix{{0.9, 0.2, 0}, {-0.2, 0.9, 0.1}, {0, 0, 0.5}}, Matrix{{0, 1}, {1, 0}, {0.5, 0.5}},
                      Matrix{{1, 0, 0}, {0, 1, 1}}, Matrix::Zero(2, 2), 0.1);
}

IdData simulated_data(const StateSpace& system, Index N, double noise, std::uint32_t seed) {
    RandomStream chance(seed);
    Matrix u(N, system.B.cols());
    for (auto column : u.colwise()) column = chance.normal(N);
    Matrix y = lsim(system, u, system.Ts, Hold::kZoh, Vector());
    for (auto column : y.colwise()) column += noise * chance.normal(N);
    return IdData(y, u, system.Ts);
}

/// Largest difference of the first Markov parameters, which no change of the state's basis alters.
double difference(const StateSpace& one, const StateSpace& other) {
    Matrix x = one.B, z = other.B;
    double worst = 0;
    for (int k = 0; k < 20; ++k, x = one.A * x, z = other.A * z)
        worst = std::max(worst, (one.C * x - other.C * z).cwiseAbs().maxCoeff());
    return worst;
}

TEST(dmdc, is_exact_for_all_states_measured) {  // oracle: the system put in
    StateSpace system = system_of_three();
    system.C = Matrix::Identity(3, 3);
    system.D = Matrix::Zero(3, 2);
    const DmdcFit found = dmdc(simulated_data(system, 200, 0, 1));
    EXPECT_EQ(found.rank, 3);
    EXPECT_LT(difference(found.system, system), 1e-10);
    EXPECT_GT(found.fit.fit_percent.minCoeff(), 99.99999);
}

TEST(dmdc, is_exact_with_as_many_delays_as_states) {  // oracle: the system put in
    const StateSpace two = system_of_three();
    const StateSpace system(two.A, two.B.leftCols(1), two.C.topRows(1), Matrix::Zero(1, 1), 0.1);
    const DmdcFit found = dmdc(simulated_data(system, 300, 0, 2), {0, 3});
    EXPECT_LT(difference(found.system, system), 1e-8);
    ASSERT_EQ(found.fit.models.size(), 1u);
    EXPECT_NEAR(found.fit.models[0].dc_gain(), to_transfer_function(system).dc_gain(), 1e-8);
}

TEST(dmdc, of_a_full_rank_is_least_squares) {  // oracle: normal equations of y(k+1) on y(k), u(k)
    const IdData data = simulated_data(system_of_three(), 300, 0.1, 3);
    const Experiment& one = data.experiments[0];
    Matrix Phi(299, 4);
    Phi << one.y.topRows(299), one.u.topRows(299);
    const Matrix AB = (Phi.transpose() * Phi).ldlt().solve(Phi.transpose() * one.y.bottomRows(299)).transpose();
    const StateSpace plain(AB.leftCols(2), AB.rightCols(2), Matrix::Identity(2, 2), Matrix::Zero(2, 2), 0.1);
    EXPECT_LT(difference(dmdc(data).system, plain), 1e-10);
}

TEST(dmdc, cuts_small_directions) {  // a fast third state of small weight; oracle: the two slow eigenvalues put in
    const StateSpace system(Matrix{{0.95, 0, 0}, {0, 0.8, 0}, {0, 0, 0.1}}, Matrix{{1}, {1}, {1e-4}},
                            Matrix::Identity(3, 3), Matrix::Zero(3, 1), 1);
    IdData data = simulated_data(system, 400, 0, 4);
    const DmdcFit found = dmdc(data, {2, 1});
    EXPECT_EQ(found.system.order(), 2);
    EXPECT_GT(found.singular_values[1], 0);
    EXPECT_EQ(found.singular_values.size(), 3);
}

TEST(dmdc, does_not_depend_on_units) {  // oracle: the same data in other units
    IdData data = simulated_data(system_of_three(), 300, 0.1, 5), other = data;
    other.experiments[0].y.col(0) *= 1000;
    other.experiments[0].u.col(1) *= 0.01;
    StateSpace one = dmdc(data, {2, 2}).system, two = dmdc(other, {2, 2}).system;
    two.C.row(0) /= 1000;
    two.B.col(1) *= 0.01;
    EXPECT_LT(difference(one, two), 1e-9);
}

TEST(dmdc, joins_experiments) {  // oracle: the system put in
    StateSpace system = system_of_three();
    system.C = Matrix::Identity(3, 3);
    system.D = Matrix::Zero(3, 2);
    const DmdcFit found = dmdc(IdData::merge({simulated_data(system, 60, 0, 6), simulated_data(system, 80, 0, 7)}));
    EXPECT_LT(difference(found.system, system), 1e-10);
}

TEST(dmdc, refuses_what_cannot_be_fitted) {
    const IdData data = simulated_data(system_of_three(), 30, 0.1, 8);
    EXPECT_THAT(thrown_message([&] { dmdc(data, {-1, 1}); }), HasSubstr("`rank` must be nonnegative"));
    EXPECT_THAT(thrown_message([&] { dmdc(data, {3, 1}); }), HasSubstr("a snapshot has only 2 values"));
    EXPECT_THAT(thrown_message([&] { dmdc(data, {2, 0}); }), HasSubstr("`delays` must be at least 1"));
    EXPECT_THAT(thrown_message([&] {
                    dmdc(data, {2, 10});
                }),
                HasSubstr("more than 40 snapshots are required, but the data have only 20"));
    EXPECT_THAT(thrown_message([&] {
                    dmdc(data, {2, 40});
                }),
                HasSubstr("more than 160 snapshots are required, but the data have only 0"));
    IdData twins = simulated_data(system_of_three(), 100, 0, 9);
    twins.experiments[0].y.col(1) = twins.experiments[0].y.col(0);
    EXPECT_THAT(thrown_message([&] { dmdc(twins, {2, 1}); }), HasSubstr("the data support only 1 singular vector"));
}

}  // namespace test_dmdc
