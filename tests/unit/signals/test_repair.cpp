#include "numerics/signals/repair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/signals/quantization.h"
#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace test_repair {

using namespace dynlab;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const double kNan = std::numeric_limits<double>::quiet_NaN();

Vector slow_sine(Index count, double noise, std::uint32_t seed = 1) {
    Vector x = noise * RandomStream(seed).normal(count);
    for (Index k = 0; k < count; ++k) x[k] += std::sin(0.05 * static_cast<double>(k));
    return x;
}

TEST(repair, gaps_become_straight_lines) {  // oracle: by hand
    const RepairedSignal filled = fill_missing(Vector{{kNan, 2, kNan, kNan, 8, kNan}});
    EXPECT_EQ(filled.signal, (Vector{{2, 2, 4, 6, 8, 8}}));
    EXPECT_THAT(filled.replaced, ElementsAre(1, 3, 4, 6));
    ASSERT_EQ(filled.stretches.size(), 3u);
    EXPECT_EQ(filled.stretches[1].first, 3);
    EXPECT_EQ(filled.stretches[1].last, 4);
    const Vector timed = fill_missing(Vector{{0, kNan, 10}}, Vector{{0, 1, 10}}).signal;
    EXPECT_DOUBLE_EQ(timed[1], 1);
    const Vector whole{{1, 2, 3}};
    EXPECT_EQ(fill_missing(Vector{{kNan, 2, kNan, kNan, 8, kNan}}, Vector(), {}, FillMethod::kPrevious).signal,
              (Vector{{2, 2, 2, 2, 8, 8}}));
    Vector long_gap = Vector::Constant(100, kNan);
    long_gap[0] = 3;
    EXPECT_EQ(fill_missing(long_gap, Vector(), {}, FillMethod::kPrevious).signal, Vector(Vector::Constant(100, 3)));
    EXPECT_THROW(fill_missing(long_gap, Vector(), 50, FillMethod::kPrevious), InvalidArgument);
    EXPECT_EQ(fill_missing(whole).signal, whole);
}

TEST(repair, long_gaps_and_empty_signals_are_refused) {
    Vector x = Vector::Ones(30);
    x.segment(5, 12).setConstant(kNan);
    EXPECT_THAT(thrown_message([&] { fill_missing(x); }), HasSubstr("samples 6 to 17 are missing"));
    EXPECT_EQ(fill_missing(x, Vector(), 12).signal, Vector::Ones(30));
    EXPECT_THROW(fill_missing(Vector::Constant(3, kNan)), InvalidArgument);
    EXPECT_THROW(fill_missing(Vector{{1, 2}}, Vector{{1.0}}), InvalidArgument);
    EXPECT_THROW(fill_missing(Vector{{1, 2}}, Vector{{2, 1}}), InvalidArgument);
}

TEST(repair, outliers_put_in_are_found_and_bridged) {  // oracle: the places and the signal before
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Vector clean = slow_sine(500, 0.02, seed);
        Vector x = clean;
        x[0] += 3, x[100] += 1, x[101] += 1.5, x[300] -= 2, x[499] = -4;
        const RepairedSignal repaired = replace_outliers(x);
        EXPECT_THAT(repaired.replaced, ElementsAre(1, 101, 102, 301, 500)) << seed;
        EXPECT_LT((repaired.signal - clean).cwiseAbs().maxCoeff(), 0.2) << seed;
    }
}

TEST(repair, outliers_of_a_record_at_rest_are_found) {  // oracle: the places
    Vector x = Vector::Constant(100, 20);
    x[49] = 84;
    EXPECT_THAT(replace_outliers(x).replaced, ElementsAre(50));
    EXPECT_EQ(replace_outliers(x).signal, Vector::Constant(100, 20));
    Vector lost_bits = Vector::Zero(400);
    for (const Index k : {10, 200, 399}) lost_bits[k] = -4096;
    EXPECT_THAT(replace_outliers(lost_bits).replaced, ElementsAre(11, 201, 400));
    for (Index k = 5; k < 400; k += 10) lost_bits[k] = 1;  // a last bit that flickers, beside them
    EXPECT_THAT(replace_outliers(lost_bits).replaced, ElementsAre(11, 201, 400));
    lost_bits[10] = lost_bits[200] = lost_bits[399] = 0;
    EXPECT_THAT(replace_outliers(lost_bits).replaced, IsEmpty());
}

TEST(repair, clean_signals_are_left_alone) {  // oracle: false alarms over seeds and kinds of signal
    Index suspected = 0;
    for (std::uint32_t seed = 1; seed <= 100; ++seed)
        suspected += static_cast<Index>(replace_outliers(slow_sine(500, 0.05, seed)).replaced.size());
    EXPECT_LE(suspected, 10);  // of 50,000 samples
    Vector step = Vector::Zero(100);
    step.tail(50).setConstant(5.0);
    EXPECT_THAT(replace_outliers(step).replaced, IsEmpty());
    EXPECT_THAT(replace_outliers(slow_sine(500, 0)).replaced, IsEmpty());
    Vector ramp = Vector::LinSpaced(200, 0, 1).array().square();
    EXPECT_THAT(replace_outliers(ramp).replaced, IsEmpty());
    const Vector coarse = (slow_sine(500, 0.01).array() * 20).round() / 20;
    EXPECT_THAT(replace_outliers(coarse).replaced, IsEmpty());
}

TEST(repair, refuses_windows_and_thresholds_that_are_none) {
    for (const Index window : {0, 1, 4, -3})
        EXPECT_THROW(replace_outliers(Vector::Ones(9), {window, 6}), InvalidArgument) << window;
    EXPECT_THROW(replace_outliers(Vector::Ones(9), {7, 0}), InvalidArgument);
    EXPECT_THROW(replace_outliers(Vector{{1, kNan}}), InvalidArgument);
    EXPECT_EQ(replace_outliers(Vector{{4.0}}).signal, (Vector{{4.0}}));
}

TEST(repair, quantization_is_the_grid_that_samples_lie_on) {  // oracle: signals rounded by us
    const Vector x = 7 + slow_sine(3000, 0.3).array();
    for (const double step : {0.1, 0.0244140625, 1.0 / 3}) {
        const Vector coarse = (x.array() / step).round() * step;
        EXPECT_NEAR(quantization_of(coarse).step, step, 1e-6 * step) << step;
        EXPECT_GT(quantization_of(coarse).levels, 5);
    }
    EXPECT_EQ(quantization_of(x).step, 0);
    EXPECT_EQ(quantization_of(Vector::Constant(9, 2.0)).levels, 1);
    EXPECT_EQ(quantization_of(Vector{{1, 2, 1, 2}}).step, 1);
}

}  // namespace test_repair
