#include "figures/histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "figures/panel_axes.h"
#include "numerics/error.h"

namespace test_histogram {

using namespace dynlab;

// Oracle: Freedman and Diaconis' rule by hand. Of 1..1000 the quartiles are 250.75 and 750.25 (interpolated), the width
// 2 * 499.5 / 10 = 99.9, and 999 / 99.9 = 10 bins.
TEST(histogram, freedman_diaconis_by_hand) {
    EXPECT_EQ(freedman_diaconis_bins(Vector::LinSpaced(1000, 1, 1000)), 10);
    EXPECT_EQ(freedman_diaconis_bins(Vector::LinSpaced(8, 0, 7)), 2);  // IQR 3.5, width 3.5, range 7
}

TEST(histogram, equal_values_make_one_bin_that_holds_them) {
    const Vector values = Vector::Constant(5, 3.0);
    ASSERT_EQ(freedman_diaconis_bins(values), 1);
    const HistogramBins bins = histogram_bins(values, 1);
    EXPECT_LT(bins.edges[0], 3.0);
    EXPECT_GT(bins.edges[1], 3.0);
    EXPECT_EQ(bins.counts[0], 5);
}

// Oracle: counting by the definition, one bin after another.
TEST(histogram, counts_agree_with_the_definition) {
    std::mt19937 generator(5);
    std::normal_distribution<double> normal;
    Vector values(1000);
    for (double& value : values) value = normal(generator);
    const HistogramBins bins = histogram_bins(values, 17);
    EXPECT_EQ(bins.counts.sum(), 1000);
    for (Index b = 0; b < 17; ++b) {
        double count = 0;
        for (const double value : values)
            count += value >= bins.edges[b] && (value < bins.edges[b + 1] || (b == 16 && value <= bins.edges[17]));
        EXPECT_EQ(bins.counts[b], count) << "bin " << b;
    }
}

// Oracle: counted by hand; 1.5 is on an edge, -1 and 9 are beyond the edges.
TEST(histogram, between_given_edges) {
    const HistogramBins bins = histogram_bins(Vector{{-1, 0, 0.4, 1.5, 2, 9}}, Vector{{-0.5, 0.5, 1.5, 2.5}});
    EXPECT_EQ(bins.counts, (Vector{{3, 0, 3}}));
    EXPECT_EQ(histogram_bins(Vector(), Vector{{0, 1, 2}}).counts, (Vector{{0, 0}}));
    EXPECT_THROW(histogram_bins(Vector{{1, 2}}, Vector{{1}}), InvalidArgument);
}

TEST(histogram, refuses_nothing_and_not_a_number) {
    EXPECT_THROW(histogram(Vector()), InvalidArgument);
    EXPECT_THROW(histogram(Vector{{1, std::nan("")}}), InvalidArgument);
}

// Oracle: counts are whole numbers, so are the axis' ticks.
TEST(histogram, few_counts_have_no_fractions_on_their_axis) {
    for (const Index values : {1, 2, 3, 5, 6, 40}) {
        HistogramOptions options;
        options.bins = 3;
        const Figure figure = histogram(Vector::Ones(values), options);
        Axis x, y;
        choose_axes(figure.panels[0], 10, 6, x, y);
        EXPECT_GE(y.ticks.size(), 2u);
        for (const Tick& tick : y.ticks) EXPECT_EQ(tick.value, std::round(tick.value)) << values << " values";
    }
}

TEST(histogram, numbers_without_measure_are_refused_or_binned) {
    EXPECT_THROW(histogram(Vector{{-1.7e308, 0, 1.7e308}}), InvalidArgument);
    EXPECT_THROW(histogram_bins(Vector{{1, 2}}, Index{1} << 40), InvalidArgument);
    EXPECT_EQ(histogram_bins(Vector{{5e-324, 5e-324}}, 3).counts.sum(), 2);
}

}  // namespace test_histogram
