#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "figures/plots/bode_plot.h"
#include "figures/plots/cross_validation_plot.h"
#include "figures/plots/pole_zero_map.h"
#include "figures/plots/residual_plot.h"
#include "figures/plots/time_response_plots.h"
#include "numerics/error.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/statistics/distributions.h"

namespace test_validation_plots {

using namespace dynlab;

const TransferFunction kG(Vector{{2.0}}, Vector{{1.0, 1.0, 4.0}});

NamedModel certain_to(double level) {
    const UncertainModel model(kG, 1e-3 * Matrix::Identity(3, 3));
    return {Message("G"), kG, ModelConfidence{model, level}};
}

const Curve* band_of(const Panel& panel) {
    for (const Curve& curve : panel.curves)
        if (curve.style == CurveStyle::kBand) return &curve;
    return nullptr;
}

double largest_stem(const Panel& panel) {
    double largest = 0;
    for (const Curve& curve : panel.curves)
        if (curve.style == CurveStyle::kStems) largest = std::max(largest, curve.y.cwiseAbs().maxCoeff());
    return largest;
}

TEST(validation_plots, step_band_is_the_response_and_its_standard_deviations) {  // oracle: step_response_std
    const Figure figure = step_plot({certain_to(0.95)});
    figure.validate();
    const Panel& panel = figure.panels[0];
    const Curve* band = band_of(panel);
    ASSERT_NE(band, nullptr);
    EXPECT_EQ(message_text(band->label), "95 % confidence");
    EXPECT_EQ(band->color, panel.curves[0].color);
    const Vector width =
        normal_half_width(0.95) * step_response_std(certain_to(0.95).confidence->model, panel.curves[0].x);
    EXPECT_LT((band->y_upper - panel.curves[0].y - width).norm(), 1e-12);
    EXPECT_LT((panel.curves[0].y - band->y - width).norm(), 1e-12);
    EXPECT_EQ(band_of(step_plot({{Message("G"), kG}}).panels[0]), nullptr);
}

TEST(validation_plots, only_the_first_of_several_bands_is_named) {
    const Figure figure = step_plot({{Message("exact"), kG}, certain_to(0.99), certain_to(0.99)});
    figure.validate();
    int bands = 0, named = 0;
    for (const Curve& curve : figure.panels[0].curves)
        if (curve.style == CurveStyle::kBand) ++bands, named += !curve.label.empty();
    EXPECT_EQ(bands, 2);
    EXPECT_EQ(named, 1);
}

/// Undetermined parameters do not distort the picture. Oracle: the height of the curve itself.
TEST(validation_plots, axes_follow_the_curves_where_a_parameter_is_undetermined) {
    const auto widest_band = [](const Panel& panel) {
        const Curve* band = band_of(panel);
        double widest = 0;
        for (Index k = 0; band != nullptr && k < band->y.size(); ++k)
            if (std::isfinite(band->y[k])) widest = std::max(widest, 0.5 * (band->y_upper[k] - band->y[k]));
        return widest;
    };
    for (const double variance : {0.3, 1e6}) {
        const UncertainModel lost(kG, variance * Matrix::Identity(3, 3));
        const NamedModel model = {Message("G"), kG, ModelConfidence{lost, 0.99}};
        const Panel step = step_plot({model}).panels[0];
        const Vector& y = step.curves[0].y;
        const double height = y.maxCoeff() - y.minCoeff();
        EXPECT_LE(widest_band(step), height);
        ASSERT_TRUE(step.y_range.has_value() || band_of(step) == nullptr || widest_band(step) <= 0.5 * height);
        const auto [low, high] = step.y_range.value_or(std::pair(y.minCoeff(), y.maxCoeff()));
        EXPECT_GE(low, y.minCoeff() - 0.5 * height - 1e-12);
        EXPECT_LE(high, y.maxCoeff() + 0.5 * height + 1e-12);
        const Figure bode = bode_plot({model});
        EXPECT_LE(widest_band(bode.panels[0]), 40) << "dB";
        EXPECT_LE(widest_band(bode.panels[1]), 180) << "degrees";
    }
    EXPECT_FALSE(step_plot({certain_to(0.95)}).panels[0].y_range.has_value()) << "a narrow band changes no axis";
}

TEST(validation_plots, bode_bands_stay_readable) {  // oracle: half the curve's height beyond it, or 20 dB
    const Figure figure = bode_plot({certain_to(0.99)});
    figure.validate();
    EXPECT_NE(band_of(figure.panels[0]), nullptr);
    EXPECT_NE(band_of(figure.panels[1]), nullptr);
    const UncertainModel vague(TransferFunction(Vector{{1.0, 0.0}}, Vector{{1.0, 1.0, 4.0}}), Matrix::Identity(4, 4));
    const Figure wide = bode_plot({{Message("G"), vague.G, ModelConfidence{vague, 0.99}}});
    wide.validate();
    ASSERT_TRUE(wide.panels[0].y_range.has_value());
    const Vector& y = wide.panels[0].curves[0].y;
    const double height = y.maxCoeff() - y.minCoeff();
    EXPECT_LE(wide.panels[0].y_range->second - wide.panels[0].y_range->first,
              height + 2 * std::max(0.5 * height, 20.0) + 1e-9);
}

TEST(validation_plots, pole_map_shows_a_region_for_every_root) {
    const Figure figure = pole_zero_map({certain_to(0.99), certain_to(0.99)});
    figure.validate();
    int regions = 0, named = 0;
    for (const Curve& curve : figure.panels[0].curves) {
        if (curve.x.size() == 73) ++regions;
        named += message_text(curve.label) == "99 % confidence";
    }
    EXPECT_EQ(regions, 4);
    EXPECT_EQ(named, 1);
}

TEST(validation_plots, residual_plot_sets_what_lies_beyond_the_bound_apart) {  // oracle: counting
    const Vector u = prbs(6, 8);
    Vector e = RandomStream(1).normal(u.size());
    for (Index k = 1; k < e.size(); ++k) e[k] += 0.8 * e[k - 1];
    const IdData data(Matrix(lsim(kG, u, 0.1) + 0.1 * e), Matrix(u), 0.1);
    const ResidualTests tests = residual_tests(data, {kG});
    const Figure figure = residual_plot(tests, data);
    figure.validate();
    ASSERT_EQ(figure.panels.size(), 2u);
    Index beyond = 0, all = 0;
    for (const Curve& curve : figure.panels[0].curves) {
        if (curve.style != CurveStyle::kStems) continue;
        all += curve.x.size();
        if (message_text(curve.label) == "outside the bound") beyond = curve.x.size();
    }
    EXPECT_EQ(all, 25);
    EXPECT_EQ(beyond, tests.outputs[0].whiteness.outside);
    EXPECT_EQ(largest_stem(figure.panels[1]), tests.outputs[0].inputs[0].correlation.cwiseAbs().maxCoeff());
    EXPECT_EQ(band_of(figure.panels[0])->y_upper[0], tests.outputs[0].whiteness.bound);
}

TEST(validation_plots, nothing_to_draw_is_refused) {
    const Vector u = prbs(6, 8);
    const IdData data(Matrix(lsim(kG, u, 0.1)), Matrix(u), 0.1);
    EXPECT_THROW(residual_plot(residual_tests(data, {kG}), data), InvalidArgument);
    EXPECT_THROW(cross_validation_plot({}, {"y1"}), InvalidArgument);
}

TEST(validation_plots, cross_validation_shows_parts_and_means) {  // oracle: the numbers given
    CrossValidation result;
    result.fit_percent = Matrix{{80.0, 50.0}, {90.0, 70.0}};
    result.mean = Vector{{85.0, 60.0}};
    const Figure figure = cross_validation_plot(result, {"y1", "y2"});
    figure.validate();
    ASSERT_EQ(figure.panels[0].curves.size(), 4u);
    EXPECT_EQ(figure.panels[0].curves[1].y, (Vector{{50.0, 70.0}}));
    EXPECT_EQ(message_text(figure.panels[0].curves[2].label), "mean 85.0 %");
}

}  // namespace test_validation_plots
