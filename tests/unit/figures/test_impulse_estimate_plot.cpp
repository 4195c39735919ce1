// Oracles: the header's definitions, exp(-t) by hand, the normal distribution's quantiles.
#include "figures/plots/impulse_estimate_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"

namespace dynlab {
namespace test_impulse_estimate_plot {

constexpr double kTs = 0.5;

ImpulseEstimate estimate_with_dead_time(Index first) {
    ImpulseEstimate estimate;
    estimate.t = Vector::LinSpaced(5, 0, 2);
    estimate.response = Vector{{0.01, -0.02, 0.4, 0.3, 0.1}};
    estimate.null_std = Vector{{0.01, 0.02, 0.03, 0.04, 0.05}};
    estimate.first = first;
    return estimate;
}

TEST(impulse_estimate_plot, draws_stems_per_second_in_the_band_of_chance) {
    const ImpulseEstimate estimate = estimate_with_dead_time(2);
    const Figure figure = impulse_estimate_plot(estimate, kTs, {}, 0.95);
    figure.validate();
    ASSERT_EQ(figure.panels[0].curves.size(), 2u);
    const Curve &band = figure.panels[0].curves[0], &stems = figure.panels[0].curves[1];
    EXPECT_EQ(stems.style, CurveStyle::kStems);
    EXPECT_NEAR((stems.y - Vector{{0.02, -0.04, 0.8, 0.6, 0.2}}).norm(), 0, 1e-12);
    EXPECT_EQ(band.style, CurveStyle::kBand);
    EXPECT_EQ(message_text(band.label), "95 % confidence bounds");
    for (Index i = 0; i < 5; ++i) {
        EXPECT_NEAR(band.y_upper[i], 1.959963984540054 * estimate.null_std[i] / kTs, 1e-8);
        EXPECT_EQ(band.y[i], -band.y_upper[i]);
    }
}

TEST(impulse_estimate_plot, marks_a_dead_time_where_there_is_one) {
    const auto vertical_lines = [](const ImpulseEstimate& estimate) {
        std::vector<ReferenceLine> lines;
        const Figure figure = impulse_estimate_plot(estimate, kTs, {});
        for (const ReferenceLine& line : figure.panels[0].references)
            if (!line.horizontal) lines.push_back(line);
        return lines;
    };
    ASSERT_EQ(vertical_lines(estimate_with_dead_time(3)).size(), 1u);
    EXPECT_EQ(vertical_lines(estimate_with_dead_time(3))[0].at, 2 * kTs);
    EXPECT_EQ(message_text(vertical_lines(estimate_with_dead_time(3))[0].label), "dead time 1 s");
    EXPECT_TRUE(vertical_lines(estimate_with_dead_time(1)).empty());
    ImpulseEstimate nothing_seen = estimate_with_dead_time(1);
    nothing_seen.first.reset();
    EXPECT_TRUE(vertical_lines(nothing_seen).empty());
}

TEST(impulse_estimate_plot, models_lie_over_it_as_their_own_impulse_responses) {
    const TransferFunction lag(Vector{{1.0}}, Vector{{1.0, 1.0}});
    const TransferFunction sampled(Vector{{0.5}}, Vector{{1.0, -0.5}}, kTs);
    const Figure figure =
        impulse_estimate_plot(estimate_with_dead_time(2), kTs, {{Message("lag"), lag}, {Message("sampled"), sampled}});
    figure.validate();
    const Curve &continuous = figure.panels[0].curves[2], &discrete = figure.panels[0].curves[3];
    EXPECT_EQ(message_text(continuous.label), "lag");
    EXPECT_EQ(continuous.x[continuous.x.size() - 1], 2);
    EXPECT_NEAR((continuous.y.array() - (-continuous.x.array()).exp()).abs().maxCoeff(), 0, 1e-9);
    EXPECT_NEAR((discrete.x - Vector{{0, 0.5, 1, 1.5, 2}}).norm(), 0, 1e-12);
    EXPECT_NEAR((discrete.y - Vector{{0, 1, 0.5, 0.25, 0.125}}).norm(), 0, 1e-12);
    EXPECT_EQ(continuous.color, 1);
    EXPECT_EQ(discrete.color, 2);
}

TEST(impulse_estimate_plot, refuses_an_empty_estimate) {
    EXPECT_THROW(impulse_estimate_plot({}, kTs, {}), InvalidArgument);
}

}  // namespace test_impulse_estimate_plot
}  // namespace dynlab
