#include <gtest/gtest.h>

#include "numerics/error.h"
#include "numerics/signals/preprocess.h"
#include "numerics/signals/random.h"

namespace test_preprocess {

using namespace dynlab;

TEST(preprocess, removes_the_mean_of_each_channel) {  // oracle: definition
    const IdData data(Matrix{{1, 10}, {3, 20}}, Vector{{5, 9}}, 1);
    const Detrended result = remove_mean(data);
    EXPECT_EQ(result.data.experiments[0].y, (Matrix{{-1, -5}, {1, 5}}));
    EXPECT_EQ(result.data.experiments[0].u, (Vector{{-2, 2}}));
    EXPECT_EQ(result.removed[0].output_offset, (Vector{{2, 15}}));
    EXPECT_EQ(result.removed[0].input_offset, (Vector{{7}}));
    EXPECT_EQ(result.removed[0].output_slope, Vector::Zero(2));
}

TEST(preprocess, removes_the_least_squares_line) {  // oracle: the normal equations and what was put in
    RandomStream random(2);
    const Vector t = (Vector{{0.0, 0.3, 1.1, 1.2, 2.5, 4.0}}).array() + 10;
    const Vector y = random.normal(6), u = 3 - 2 * (t.array() - 10);
    const Detrended result = detrend(IdData(y, u, t), TrendKind::kLinear);
    const Experiment& rest = result.data.experiments[0];
    EXPECT_NEAR(rest.y.sum(), 0, 1e-14);
    EXPECT_NEAR(rest.y.col(0).dot(t), 0, 1e-13);
    EXPECT_LT(rest.u.lpNorm<Eigen::Infinity>(), 1e-14);
    const Trend& removed = result.removed[0];
    EXPECT_NEAR(removed.input_offset(0), 3, 1e-13);
    EXPECT_NEAR(removed.input_slope(0), -2, 1e-13);
    const Vector line = removed.output_offset(0) + removed.output_slope(0) * (t.array() - t(0));
    EXPECT_LT((rest.y + line - y).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(preprocess, treats_experiments_one_by_one) {  // oracle: second route, each alone
    const IdData a(Vector{{1, 2}}, Matrix(), 1), b(Vector{{5, 9, 4}}, Matrix(), 1);
    const Detrended both = remove_mean(IdData::merge({a, b}));
    EXPECT_EQ(both.data.experiments[0].y, remove_mean(a).data.experiments[0].y);
    EXPECT_EQ(both.data.experiments[1].y, remove_mean(b).data.experiments[0].y);
    EXPECT_EQ(both.removed.size(), 2u);
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
    const Detrended result = remove_initial_level(IdData(Matrix(y), Matrix(u), 1));
    EXPECT_NEAR(result.removed[0].output_offset(0), 20, 1e-14);
    EXPECT_NEAR(result.removed[0].input_offset(0), 2, 1e-14);
    EXPECT_NEAR(result.data.experiments[0].y(9, 0), 5, 1e-13);
    EXPECT_NEAR(result.data.experiments[0].u(9, 0), 1, 1e-13);
}

TEST(preprocess, the_calm_beginning_may_be_told) {  // oracle: definition
    const Vector u{{0, 1, 0, 1, 0}}, y{{2, 4, 9, 9, 9}};
    const IdData data(Matrix(y), Matrix(u), 1);
    EXPECT_THROW(remove_initial_level(data), InvalidArgument);
    EXPECT_EQ(remove_initial_level(data, 2).removed[0].output_offset(0), 3);
    EXPECT_THROW(remove_initial_level(data, 6), InvalidArgument);
    EXPECT_THROW(remove_initial_level(IdData(Matrix(y), Matrix(), 1)), InvalidArgument);
    EXPECT_EQ(remove_initial_level(IdData(Matrix(y), Matrix(), 1), 2).removed[0].output_offset(0), 3);
}

}  // namespace test_preprocess
