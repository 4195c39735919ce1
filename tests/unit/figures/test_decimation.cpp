#include "figures/decimation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace test_decimation {

using namespace dynlab;

constexpr double kCell = 0.01;

Trace noise(std::size_t count, double width, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    Trace trace(count);
    for (std::size_t i = 0; i < count; ++i)
        trace[i] = {width * static_cast<double>(i) / static_cast<double>(count), normal(generator)};
    return trace;
}

std::map<long, std::pair<double, double>> column_extremes(const Trace& trace) {
    std::map<long, std::pair<double, double>> extremes;
    for (const PagePoint& point : trace) {
        auto [place, fresh] = extremes.try_emplace(std::lround(std::floor(point.x / kCell)), point.y, point.y);
        place->second = {std::min(place->second.first, point.y), std::max(place->second.second, point.y)};
    }
    return extremes;
}

// Oracle: the definition. Every column of the thinned curve spans what it spans in the original, so that the drawn
// vertical extent is the same in each.
TEST(decimation, keeps_the_extremes_of_every_column) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Trace original = noise(1000000, 14, seed);
        const Trace thinned = decimate_line(original, kCell);
        EXPECT_LE(thinned.size(), 4u * 1401u);
        EXPECT_EQ(column_extremes(thinned), column_extremes(original));
    }
}

TEST(decimation, keeps_order_and_both_ends) {
    const Trace original = noise(50000, 10, 7), thinned = decimate_line(original, kCell);
    EXPECT_EQ(thinned.front().y, original.front().y);
    EXPECT_EQ(thinned.back().y, original.back().y);
    for (std::size_t i = 1; i < thinned.size(); ++i) EXPECT_LT(thinned[i - 1].x, thinned[i].x);
}

TEST(decimation, leaves_few_points_as_they_are) {
    const Trace original = noise(500, 10, 7), thinned = decimate_line(original, kCell);
    ASSERT_EQ(thinned.size(), original.size());
    for (std::size_t i = 0; i < original.size(); ++i) EXPECT_EQ(thinned[i].y, original[i].y);
}

TEST(decimation, gaps_stay) {
    Trace original = noise(10000, 1, 7);
    original[5000].y = std::numeric_limits<double>::quiet_NaN();
    const Trace thinned = decimate_line(original, kCell);
    EXPECT_EQ(std::count_if(thinned.begin(), thinned.end(), [](const PagePoint& p) { return p.gap(); }), 1);
}

// Oracle: the promise in the header, for a curve that crosses columns again and again.
TEST(decimation, curves_that_run_to_and_fro_stay_small_and_near_the_original) {
    Trace circle(400000);
    for (std::size_t i = 0; i < circle.size(); ++i) {
        const double angle = 1.7 * static_cast<double>(i);
        circle[i] = {3 * std::cos(angle), 3 * std::sin(angle)};
    }
    const Trace thinned = decimate_line(circle, kCell);
    EXPECT_LE(thinned.size(), 20000u);
    EXPECT_GE(thinned.size(), 300u);
    for (const PagePoint& point : thinned) {
        if (point.gap()) continue;
        EXPECT_NEAR(std::hypot(point.x, point.y), 3, 1e-9);
    }
}

TEST(decimation, markers_on_top_of_one_another_are_drawn_once) {
    const Trace points = {{1.001, 1.001}, {1.002, 1.002}, {5, 5}, {1.001, 1.001}};
    EXPECT_EQ(decimate_points(points, kCell).size(), 2u);
    EXPECT_LE(decimate_points(noise(1000000, 14, 3), 1e-6).size(), 20000u);
}

TEST(decimation, bands_keep_their_outer_edges) {
    Trace lower = noise(100000, 1, 1), upper = lower;
    for (PagePoint& point : upper) point.y += 1;
    const auto [thin_lower, thin_upper] = decimate_band(lower, upper, kCell);
    ASSERT_EQ(thin_lower.size(), thin_upper.size());
    const auto lowest = column_extremes(lower), highest = column_extremes(upper);
    ASSERT_EQ(thin_lower.size(), lowest.size());
    for (std::size_t i = 0; i < thin_lower.size(); ++i) {
        const long column = std::lround(std::floor(thin_lower[i].x / kCell));
        EXPECT_EQ(thin_lower[i].y, lowest.at(column).first);
        EXPECT_EQ(thin_upper[i].y, highest.at(column).second);
    }
}

}  // namespace test_decimation
