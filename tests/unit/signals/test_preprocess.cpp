#include <gtest/gtest.h>

#include "numerics/error.h"
#include "numerics/signals/preprocess.h"
#include "numerics/signals/random.h"

namespace test_preprocess {

using namespace dynlab;

TEST(preprocess, removes_the_mean_of_each_channel) {  // oracle: definition
    const IdData data(Matrix{{1, 10}, {3, 20}}, Vector{{5, 9}}, 1);
    const Experiment rest = remove_mean(data).experiments[0];
    EXPECT_EQ(rest.y, (Matrix{{-1, -5}, {1, 5}}));
    EXPECT_EQ(rest.u, (Vector{{-2, 2}}));
}

TEST(preprocess, removes_the_least_squares_line) {  // oracle: the normal equations and what was put in
    RandomStream random(2);
    const Vector t = (Vector{{0.0, 0.3, 1.1, 1.2, 2.5, 4.0}}).array() + 10;
    const Vector y = random.normal(6), u = 3 - 2 * (t.array() - 10);
    const Experiment rest = detrend(IdData(y, u, t), TrendKind::kLinear).experiments[0];
    EXPECT_NEAR(rest.y.sum(), 0, 1e-14);
    EXPECT_NEAR(rest.y.col(0).dot(t), 0, 1e-13);
    EXPECT_LT(rest.u.lpNorm<Eigen::Infinity>(), 1e-14);
    const Vector line = y - rest.y;
    for (Index k = 2; k < 6; ++k)
        EXPECT_NEAR((line[k] - line[0]) * (t[1] - t[0]), (line[1] - line[0]) * (t[k] - t[0]), 1e-14);
}

TEST(preprocess, treats_experiments_one_by_one) {  // oracle: second route, each alone
    const IdData a(Vector{{1, 2}}, Matrix(), 1), b(Vector{{5, 9, 4}}, Matrix(), 1);
    const IdData both = remove_mean(IdData::merge({a, b}));
    ASSERT_EQ(both.experiments.size(), 2u);
    EXPECT_EQ(both.experiments[0].y, remove_mean(a).experiments[0].y);
    EXPECT_EQ(both.experiments[1].y, remove_mean(b).experiments[0].y);
}

TEST(preprocess, a_line_needs_two_samples) {
    const IdData one(Vector{{1.0}}, Matrix(), 1);
    EXPECT_THROW(detrend(one, TrendKind::kLinear), InvalidArgument);
    EXPECT_NO_THROW(remove_mean(one));
}

TEST(preprocess, the_level_before_the_step_is_taken_off) {  // oracle: what was put in
    Vector u = Vector::Constant(10, 2.0), y = Vector::Constant(10, 20.0);
    u.tail(6).setConstant(3.0), y.tail(5).setConstant(25.0);
    y[0] += 0.3, y[1] -= 0.3;
    u[1] += 0.01, u[2] -= 0.01;  // a noisy input has not stepped yet
    const Experiment rest = remove_initial_level(IdData(Matrix(y), Matrix(u), 1)).experiments[0];
    EXPECT_LT((rest.y - (y.array() - 20).matrix()).lpNorm<Eigen::Infinity>(), 1e-13);
    EXPECT_LT((rest.u - (u.array() - 2).matrix()).lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST(preprocess, the_calm_beginning_may_be_given) {  // oracle: definition
    const Vector u{{0, 1, 0, 1, 0}}, y{{2, 4, 9, 9, 9}};
    const IdData data(Matrix(y), Matrix(u), 1);
    EXPECT_THROW(remove_initial_level(data), InvalidArgument);
    EXPECT_EQ(remove_initial_level(data, 2).experiments[0].y, (Vector{{-1, 1, 6, 6, 6}}));
    EXPECT_THROW(remove_initial_level(data, 6), InvalidArgument);
    EXPECT_THROW(remove_initial_level(IdData(Matrix(y), Matrix(), 1)), InvalidArgument);
    EXPECT_EQ(remove_initial_level(IdData(Matrix(y), Matrix(), 1), 2).experiments[0].y, (Vector{{-1, 1, 6, 6, 6}}));
}

}  // namespace test_preprocess
