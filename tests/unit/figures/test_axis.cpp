#include "figures/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace test_axis {

using namespace dynlab;

// Oracle: properties of a readable axis, over ranges of all magnitudes.
TEST(axis, ticks_lie_inside_and_are_few_and_evenly_spaced) {
    for (const double scale : {1e-300, 1e-12, 1e-9, 1e-3, 1.0, 37.0, 1e5, 1e12, 1e300})
        for (const auto& [low, high] : {std::pair{0.0, 1.0}, {-1.0, 1.0}, {-5.0, -4.9}, {0.3, 0.7}}) {
            const Axis axis = make_axis({low * scale, high * scale}, false, 6);
            ASSERT_GE(axis.ticks.size(), 2u) << scale;
            ASSERT_LE(axis.ticks.size(), 13u) << scale;
            const double step = axis.ticks[1].value - axis.ticks[0].value;
            for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
                const double place = axis.position(axis.ticks[i].value);
                EXPECT_GE(place, -1e-6);
                EXPECT_LE(place, 1 + 1e-6);
                EXPECT_LE(axis.ticks[i].label.size(), 10u) << axis.ticks[i].label;
                if (i > 0) {
                    EXPECT_NEAR(axis.ticks[i].value - axis.ticks[i - 1].value, step, 1e-6 * step);
                    EXPECT_NE(axis.ticks[i].label, axis.ticks[i - 1].label);
                }
            }
        }
}

// Oracle: the number written times its power of ten is the number meant.
TEST(axis, labels_times_the_common_power_are_the_values) {
    const Axis axis = make_axis({0, 8e-9}, false, 5);
    EXPECT_EQ(axis.exponent, -9);
    for (const Tick& tick : axis.ticks) EXPECT_NEAR(std::stod(tick.label) * 1e-9, tick.value, 1e-15);
}

TEST(axis, logarithmic_axes_number_decades) {
    const Axis axis = make_axis({1e-2, 1e3}, true, 8);
    ASSERT_EQ(axis.ticks.size(), 6u);
    EXPECT_EQ(axis.ticks[0].label, "10^{−2}");
    EXPECT_EQ(axis.minor.size(), 5u * 8u);
    EXPECT_NEAR(axis.position(axis.ticks[2].value), 0.4, 1e-12);
}

TEST(axis, single_values_are_given_room) {
    for (const double value : {0.0, 5.0, -1e12, 1e-9}) {
        Extent extent(false);
        extent.include(value);
        const auto [low, high] = extent.padded(0.05);
        EXPECT_LT(low, value);
        EXPECT_GT(high, value);
    }
}

TEST(axis, wanted_steps_are_kept) {
    const Axis axis = make_axis({-190, 10}, false, 5, 45);
    ASSERT_EQ(axis.ticks.size(), 5u);
    EXPECT_EQ(axis.ticks[0].value, -180);
}

// Oracle: an axis is a rising map of a finite range with few numbers, whatever the numbers are.
TEST(axis, numbers_without_measure_make_an_axis_that_ends) {
    constexpr double kValues[] = {5e-324, 1e-310, 1e-300, 1, 1e300, 1e308, 1.7e308};
    for (const bool log : {true, false})
        for (const double a : kValues)
            for (const double b : kValues) {
                Extent extent(log);
                extent.include(a);
                extent.include(log ? b : -b);
                const auto range = extent.padded(0.06);
                for (const double count : {1.0, 4.0, 20.0}) {
                    const Axis axis = make_axis(range, log, count);
                    ASSERT_TRUE(std::isfinite(axis.low) && std::isfinite(axis.high)) << a << " " << b;
                    ASSERT_LT(axis.low, axis.high) << a << " " << b;
                    EXPECT_LE(axis.ticks.size(), 101u) << a << " " << b;
                    EXPECT_LE(axis.minor.size(), 6000u) << a << " " << b;
                    EXPECT_NEAR(axis.position(axis.low), 0, 1e-9);
                    EXPECT_NEAR(axis.position(axis.high), 1, 1e-9);
                }
            }
}

TEST(axis, given_ends_without_measure_make_an_axis_that_ends) {
    const double infinity = std::numeric_limits<double>::infinity(), least = 5e-324;
    for (const bool log : {true, false})
        for (const auto& [low, high] :
             {std::pair{1.0, infinity}, {least, 2 * least}, {1e306, 1e308}, {least, 1.7e308}, {1.0, 1 + 2.3e-16}}) {
            const Axis axis = make_axis({low, high}, log, 8);
            EXPECT_LT(axis.low, axis.high) << low << " " << high;
            EXPECT_LE(axis.ticks.size(), 101u) << low << " " << high;
        }
}

}  // namespace test_axis
