// Oracle: the standard plots as poppler draws them in grey; what a reader needs of their axes.
#include "figures/style.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "figures/confidence_band.h"
#include "figures/figure_layout.h"
#include "figures/plots/bode_plot.h"
#include "figures/plots/compare_plot.h"
#include "figures/plots/cross_validation_plot.h"
#include "figures/plots/id_plot.h"
#include "figures/plots/monte_carlo_plot.h"
#include "figures/plots/nyquist_plot.h"
#include "figures/plots/order_plot.h"
#include "figures/plots/pole_zero_map.h"
#include "figures/plots/residual_plot.h"
#include "figures/plots/spectral_plot.h"
#include "figures/plots/time_response_plots.h"
#include "figures/step_construction.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/frequency_response.h"
#include "numerics/simulation/lsim.h"
#include "support/grey_looks.h"

namespace test_style {

using namespace dynlab;

TransferFunction second_order(double damping) {
    return TransferFunction(Vector{{1.0}}, Vector{{1.0, 2 * damping, 1.0}});
}

std::vector<NamedModel> models(int count) {
    std::vector<NamedModel> result;
    for (int i = 0; i < count; ++i)
        result.push_back({Message::verbatim("G_" + std::to_string(i)), second_order(0.2 + 0.1 * i)});
    return result;
}

IdData simulated_data(int seed) {
    RandomStream random(static_cast<std::uint32_t>(seed));
    const Vector u = random.normal(200).array().sign();
    return IdData(Matrix(lsim(second_order(0.4), u, 0.1) + 0.3 * random.normal(200)), Matrix(u), 0.1);
}

Figure compared(int count) {
    const IdData data = simulated_data(1);
    std::vector<ModelOutput> outputs;
    for (int i = 0; i < count; ++i)
        outputs.push_back({Message("G"), data.experiments[0].y * (1 - 0.1 * i), Vector::Constant(1, 80)});
    return compare_plot(data, outputs);
}

Figure residuals() {
    const IdData data = simulated_data(2);
    return residual_plot(residual_tests(data, {second_order(0.2)}), data);
}

Figure plain(int count) {
    Panel panel;
    for (int i = 0; i < count; ++i) {
        Curve curve;
        curve.x = Vector::LinSpaced(20, 0, 1);
        curve.y = curve.x * i;
        curve.label = Message::verbatim(std::to_string(i));
        panel.curves.push_back(std::move(curve));
    }
    return Figure(std::move(panel));
}

Figure constructed() {
    StepConstruction input;
    input.t = Vector::LinSpaced(101, 0, 50);
    input.y = input.smoothed = 20 + 10 * (1 - (-(input.t.array() - 10).max(0) / 5).exp());
    input.step_time = 10, input.initial = 20, input.final = 30;
    input.readings = {{"settling", 25, 29.5}};
    return step_construction(input);
}

std::vector<std::pair<std::string, Figure>> standard_figures() {
    const IdData a = simulated_data(1), b = simulated_data(2), c = simulated_data(3), d = simulated_data(4);
    return {{"plot", plain(12)},
            {"step", step_plot(models(6))},
            {"impulse", impulse_plot(models(4))},
            {"bode", bode_plot(models(5))},
            {"nyquist", nyquist_plot(models(4))},
            {"compare", compared(7)},
            {"resid", residuals()},
            {"idplot", id_plot({&a, &b, &c, &d})},
            {"step_first_order", constructed()}};
}

MonteCarlo study(int methods) {
    MonteCarlo result;
    for (int i = 0; i < methods; ++i) {
        MonteCarloResult one;
        one.label = "method " + std::to_string(i);
        one.names = {"a1", "b0"};
        one.theta = Matrix::Random(20, 2);
        one.truth = Vector::Zero(2);
        one.bound = Matrix::Identity(2, 2);
        one.estimated = 20;
        result.results.push_back(one);
    }
    return result;
}

OrderSelection orders(int zeros) {
    OrderSelection result;
    for (int m = 0; m < zeros; ++m)
        for (int n = 1; n < 4; ++n) {
            OrderCandidate one;
            one.poles = n, one.zeros = m, one.bic = -m - n;
            result.candidates.push_back(one);
        }
    return result;
}

std::vector<NamedModel> models_with_zeros(int count) {
    std::vector<NamedModel> result;
    for (int i = 0; i < count; ++i)
        result.push_back({Message::verbatim("G_" + std::to_string(i)),
                          TransferFunction(Vector{{1.0, 1.0 + i}}, Vector{{1.0, 0.5, 1.0}})});
    return result;
}

SpectralEstimate spectrum() {
    SpectralEstimate result;
    result.w = Vector::LinSpaced(20, 0.1, 3);
    result.response = frequency_response(second_order(0.3), result.w);
    result.std = 0.1 * result.response.cwiseAbs();
    return result;
}

CrossValidation folds(Index outputs) {
    CrossValidation result;
    result.fit_percent = 80 * Matrix::Ones(5, outputs);
    result.mean = 80 * Vector::Ones(outputs);
    return result;
}

/// Those whose axes are tested elsewhere.
std::vector<std::pair<std::string, Figure>> further_figures() {
    return {{"pzmap", pole_zero_map(models_with_zeros(3))},
            {"scatter", monte_carlo_scatter(study(3), "a1", "b0")},
            {"order selection", order_plot(orders(5), OrderCriterion::kBic, {1, {}})},
            {"spa", spectral_plot(spectrum(), Message("estimate"), models(3))},
            {"crossvalidate", cross_validation_plot(folds(3), {"x", "y", "z"})}};
}

TEST(style, curves_of_the_standard_plots_are_distinguished_in_grey) {
    auto figures = standard_figures();
    for (auto& further : further_figures()) figures.push_back(std::move(further));
    for (const auto& [name, figure] : figures)
        for (const Panel& panel : figure.panels) {
            const test::GreyLooks looks(panel);
            for (std::size_t i = 0; i + 1 < looks.size(); ++i)
                EXPECT_GT(looks.difference(i, i + 1), test::kSeenInGrey)
                    << name << ", curves " << i << " and " << i + 1;
        }
}

TEST(style, no_two_of_nine_curves_look_alike_in_grey) {
    const test::GreyLooks looks(plain(9).panels[0]);
    ASSERT_EQ(looks.size(), 9u);
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_GT(looks.difference(i, k), test::kSeenInGrey) << i << " and " << k;
}

TEST(style, scatters_of_six_methods_are_distinguished_in_grey) {
    const test::GreyLooks looks(monte_carlo_scatter(study(6), "a1", "b0").panels[0]);
    ASSERT_EQ(looks.size(), 8u);  // with the ellipse and the true value
    for (std::size_t i = 0; i < looks.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_GT(looks.difference(i, k), test::kSeenInGrey) << i << " and " << k;
}

TEST(style, bands_of_six_models_are_distinguished_in_grey) {
    Panel panel;
    for (int i = 0; i < 6; ++i) {
        Curve line;
        line.x = line.y = Vector::LinSpaced(12, 0, 1);
        line.color = i;
        panel.curves.push_back(line);
    }
    for (std::size_t i = 0; i < 6; ++i) add_confidence_band(panel, i, Vector::Constant(12, 0.1), 0.95);
    const test::GreyLooks looks(panel, test::GreyLooks::Of::kBands);
    ASSERT_EQ(looks.size(), 6u);
    for (std::size_t i = 0; i < looks.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_GT(looks.difference(i, k), test::kSeenInGrey) << i << " and " << k;
}

TEST(style, the_ninth_model_does_not_look_like_the_first) {
    for (const Panel& panel : bode_plot(models(9)).panels) {
        const auto look = [&](std::size_t i) { return style::appearance_of(panel.curves[i], static_cast<int>(i)); };
        EXPECT_EQ(look(0).color, look(8).color);
        EXPECT_NE(look(0).dash, look(8).dash);
    }
}

// A filled circle and an open square.
TEST(style, stems_beyond_the_bound_have_a_marker_of_their_own) {
    std::map<bool, std::set<int>> markers;
    for (const Panel& panel : residuals().panels)
        for (const Curve& curve : panel.curves)
            if (curve.style == CurveStyle::kStems)
                markers[message_text(curve.label) == "outside the bound"].insert(
                    style::appearance_of(curve, 0).point_type);
    ASSERT_EQ(markers.size(), 2u);
    EXPECT_NE(markers[false], markers[true]);
}

TEST(style, the_measurement_is_wider_than_the_model_upon_it) {
    for (const Panel& panel : compared(1).panels)
        EXPECT_GE(panel.curves[0].line_width, 2 * panel.curves[1].line_width + 0.5);
}

TEST(style, every_axis_of_the_standard_plots_has_four_numbers) {
    auto figures = standard_figures();
    figures.emplace_back("bode of an integrator",
                         bode_plot({{{}, TransferFunction(Vector{{1.0}}, Vector{{1.0, 0.0}})}}));
    figures.emplace_back("bode of a gain with a lag",
                         bode_plot({{{}, TransferFunction(Vector{{3.0}}, Vector{{1.0, 2.0}})}}));
    for (const auto& [name, figure] : figures)
        for (const PanelLayout& panel : lay_out(figure).panels) {
            EXPECT_GE(panel.x.ticks.size(), 4u) << name << ", x from " << panel.x.low << " to " << panel.x.high;
            EXPECT_GE(panel.y.ticks.size(), 4u) << name << ", y from " << panel.y.low << " to " << panel.y.high;
            EXPECT_LE(panel.y.ticks.size(), 9u) << name;
        }
}

}  // namespace test_style
