// Oracles: decibels, degrees and first-order errors by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "figures/plots/bode_plot.h"
#include "figures/plots/levels_plot.h"
#include "numerics/simulation/frequency_response.h"
#include "support/thrown_message.h"

namespace test_frequency_plots {

using namespace dynlab;
using testing::HasSubstr;

constexpr double kQuantile = 2.5758293035489004;  // of 99 %, two-sided
const TransferFunction kLag(Vector{{2.0}}, Vector{{1.0, 1.0}}, 0, 3);
const Vector kFrequencies{{0.5, 2.0, 4.0}};

FrequencyData measured() {
    return frequency_data(frequency_response(kLag, kFrequencies), kFrequencies, Vector{{0.02, 0.02, 0.08}});
}

TEST(frequency_plots, measured_responses_are_points_with_bands) {
    const Figure figure = bode_plot({}, Vector(), {{Message("measured"), measured(), 0.99}});
    figure.validate();
    const Curve &points = figure.panels[0].curves[0], &band = figure.panels[0].curves[1];
    EXPECT_EQ(points.style, CurveStyle::kPoints);
    EXPECT_EQ(message_text(points.label), "measured");
    EXPECT_NEAR(points.y[1], 20 * std::log10(2 / std::sqrt(5.0)), 1e-12);
    ASSERT_EQ(band.style, CurveStyle::kBand);
    EXPECT_NEAR(band.y_upper[1] - points.y[1], kQuantile * 20 / std::numbers::ln10 * 0.1 / (2 / std::sqrt(5.0)), 1e-9);
    EXPECT_EQ(figure.panels[0].x_range, std::pair(0.5, 4.0));
}

TEST(frequency_plots, models_beside_held_samples_are_held) {  // oracle: 1 - exp(-Ts) over z - exp(-Ts), by hand
    const TransferFunction lag(Vector{{1.0}}, Vector{{1.0, 1.0}});
    const double Ts = 0.5, a = std::exp(-Ts);
    const Vector w{{1.0, 3.0}};
    ComplexVector H(2);
    for (Index k = 0; k < 2; ++k) H[k] = (1 - a) / (std::polar(1.0, w[k] * Ts) - a);
    const FrequencyData held = frequency_data(H, w, Vector(), Ts, InterSample::kZoh);
    const Figure figure = bode_plot({{Message("lag"), lag}}, w, {{Message("measured"), held, 0.99}});
    EXPECT_EQ(message_text(figure.panels[0].curves[0].label), "lag, zero-order hold");
    for (const Panel& panel : figure.panels)
        EXPECT_LT((panel.curves[0].y - panel.curves[1].y).cwiseAbs().maxCoeff(), 1e-9);
    const FrequencyData sines = frequency_data(H, w, Vector());
    const std::vector<NamedResponse> both = {{Message("a"), held, 0.99}, {Message("b"), sines, 0.99}};
    EXPECT_EQ(bode_plot({{Message("lag"), lag}}, w, both).panels[0].curves[0].label, Message("lag"));
}

TEST(frequency_plots, phases_lie_beside_the_models) {
    // 4 rad/s: -76 degrees of the lag and -687.5 of the delay; from 2 rad/s on alone they would not be unwrapped so far
    const Figure figure = bode_plot({{Message("model"), kLag}}, Vector(), {{Message("measured"), measured(), 0.99}});
    const Curve& points = figure.panels[1].curves[1];
    ASSERT_EQ(points.style, CurveStyle::kPoints);
    const Vector beside = phase_degrees(kLag, kFrequencies);
    EXPECT_NEAR(beside[beside.size() - 1], -76 - 687.5, 0.1);
    EXPECT_LT((points.y - beside).cwiseAbs().maxCoeff(), 180);
}

TEST(frequency_plots, levels_are_decibels_of_what_is_above_zero) {
    FrequencyData data = measured();
    data.excited = {kFrequencies, Vector{{1.0, 0.1, 0.01}}, Vector{{1e-4, 1e-4, 1e-4}}, Vector{{1e-3, -1e-9, 1e-3}}};
    data.even = {Vector{{1.0}}, Vector{{1e-5}}, Vector{{1e-6}}, Vector{{9e-6}}};
    const Figure figure = levels_plot(data);
    figure.validate();
    const std::vector<Curve>& curves = figure.panels[0].curves;
    ASSERT_EQ(curves.size(), 4u);
    EXPECT_LT((curves[0].y - Vector{{0.0, -10.0, -20.0}}).norm(), 1e-12);
    EXPECT_NEAR(curves[1].y[0], -40, 1e-12);
    EXPECT_TRUE(std::isnan(curves[2].y[1]));
    EXPECT_EQ(message_text(curves[3].label), "even lines without input");
    EXPECT_THAT(thrown_message([] { levels_plot(measured()); }), HasSubstr("no output levels"));
}

}  // namespace test_frequency_plots
