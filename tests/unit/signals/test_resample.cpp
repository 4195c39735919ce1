#include "numerics/signals/resample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/signals/extension.h"

namespace test_resample {

using namespace dynlab;

/// sin(w k + 0.4) at k = 0, step, 2 step, ...
Vector sampled_sine(double w, Index count, double step = 1) {
    Vector x(count);
    for (Index k = 0; k < count; ++k) x[k] = std::sin(w * step * static_cast<double>(k) + 0.4);
    return x;
}

double inner_error(const Vector& a, const Vector& b, Index margin) {
    return (a - b).segment(margin, a.size() - 2 * margin).cwiseAbs().maxCoeff();
}

TEST(resample, keeps_sines_that_the_lower_rate_can_carry) {  // oracle: the sine at the new instants
    for (const auto& [up, down] :
         std::vector<std::pair<Index, Index>>{{1, 2}, {1, 10}, {3, 1}, {2, 3}, {5, 4}, {48, 35}}) {
        const double rate = static_cast<double>(up) / static_cast<double>(down);
        for (const double part : {0.05, 0.4, 0.79}) {
            const double w = part * std::numbers::pi * std::min(1.0, rate);
            const Vector y = resample_signal(sampled_sine(w, 2000), up, down);
            const Index margin = static_cast<Index>(34 * std::max(1.0, rate)) + 1;
            EXPECT_LT(inner_error(y, sampled_sine(w, y.size(), 1 / rate), margin), 2e-5)
                << up << "/" << down << " " << w;
        }
    }
}

TEST(resample, removes_what_the_lower_rate_cannot_carry) {  // oracle: no alias is left of a fast sine
    for (const Index down : {2, 5, 20})
        for (const double w : {1.001 * std::numbers::pi / static_cast<double>(down), 0.9 * std::numbers::pi}) {
            const Vector y = resample_signal(sampled_sine(w, 4000), 1, down);
            EXPECT_LT(y.segment(34, y.size() - 68).cwiseAbs().maxCoeff(), 2e-5) << down << " " << w;
        }
}

TEST(resample, keeps_constants_and_lines) {  // oracle: definition; lines by the symmetry of the filter
    Vector line(101);
    for (Index k = 0; k < line.size(); ++k) line[k] = 3 + 0.5 * static_cast<double>(k);
    const Vector constant = Vector::Constant(101, 7.0);
    for (const auto& [up, down] : std::vector<std::pair<Index, Index>>{{1, 4}, {3, 2}}) {
        const Vector y = resample_signal(line, up, down), level = resample_signal(constant, up, down);
        ASSERT_EQ(y.size(), 100 * up / down + 1);
        for (Index m = 0; m < y.size(); ++m) {
            const double at = static_cast<double>(m * down) / static_cast<double>(up);
            EXPECT_NEAR(y[m], 3 + 0.5 * at, 2e-5);
        }
        EXPECT_LT((level.array() - 7).abs().maxCoeff(), 1e-13);
    }
}

TEST(resample, factors_are_reduced) {  // oracle: the same ratio
    const Vector x = sampled_sine(0.3, 300);
    EXPECT_EQ(resample_signal(x, 4, 6), resample_signal(x, 2, 3));
    EXPECT_EQ(resample_signal(x, 7, 7), x);
}

TEST(resample, data_keep_names_times_and_experiments) {  // oracle: each signal alone
    const Vector y = sampled_sine(0.2, 400), u = sampled_sine(0.1, 400);
    IdData data(Matrix(y), Matrix(u), 0.5);
    data.experiments[0].start_time = 3;
    const IdData slow = resample(IdData::merge({data, data.range(1, 200)}), 1, 4);
    EXPECT_EQ(slow.Ts, 2);
    EXPECT_EQ(slow.time()(1), 5);
    ASSERT_EQ(slow.experiments.size(), 2u);
    EXPECT_EQ(slow.sample_count(0), 100);
    EXPECT_EQ(slow.sample_count(1), 50);
    EXPECT_EQ(slow.experiments[0].y.col(0), resample_signal(y, 1, 4));
    EXPECT_EQ(slow.experiments[0].u.col(0), resample_signal(u, 1, 4));
}

TEST(resample, refuses_what_it_cannot_do) {
    const Vector x = sampled_sine(0.3, 30);
    for (const auto& [up, down] : std::vector<std::pair<Index, Index>>{{0, 1}, {1, 0}, {-1, 2}, {1001, 1}, {1, 1001}})
        EXPECT_THROW(resample_signal(x, up, down), InvalidArgument);
    EXPECT_THROW(resample(IdData(Matrix(x), Matrix(), 1), 1, 40), InvalidArgument);
    EXPECT_THROW(resample(IdData(Matrix(Vector{{1, 2, 3}}), Matrix(), Vector{{0, 1, 3}}), 1, 2), InvalidArgument);
    EXPECT_EQ(resample_signal(Vector(), 1, 2).size(), 0);
}

TEST(resample, continuation_reflects_in_the_end_points) {  // oracle: definition, by hand
    const Vector x{{1.0, 2.0, 5.0}};
    EXPECT_EQ(point_reflected(x, 2), (Vector{{-3, 0, 1, 2, 5, 8, 9}}));
    EXPECT_EQ(point_reflected(x, 5), (Vector{{-8, -7, -6, -3, 0, 1, 2, 5, 8, 9, 10, 13, 16}}));
    EXPECT_EQ(point_reflected(Vector{{4.0}}, 2), Vector::Constant(5, 4.0));
}

}  // namespace test_resample
