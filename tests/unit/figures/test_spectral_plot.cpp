// Oracles: decibels and degrees of a first-order lag by hand, the normal distribution's 99 % quantile.
#include "figures/plots/spectral_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "figures/style.h"
#include "numerics/error.h"

namespace dynlab {
namespace test_spectral_plot {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kQuantile = 2.5758293035489004;  // of 99 %, two-sided

/// 2/(1 + jw) at 0, 0.5, 1, 2.
SpectralEstimate lag() {
    SpectralEstimate estimate;
    estimate.w = Vector{{0, 0.5, 1, 2}};
    estimate.response.resize(4);
    for (Index i = 0; i < 4; ++i) estimate.response[i] = 2.0 / Complex(1, estimate.w[i]);
    return estimate;
}

const TransferFunction kLag(Vector{{2.0}}, Vector{{1.0, 1.0}});

TEST(spectral_plot, draws_decibels_over_degrees_from_the_lowest_frequency_above_zero) {
    const Figure figure = spectral_plot(lag(), Message("etfe"), {});
    figure.validate();
    ASSERT_EQ(figure.panels.size(), 2u);
    EXPECT_EQ(figure.rows, 2);
    for (Index i = 0; i < 4; ++i) {
        const double w = lag().w[i];
        EXPECT_NEAR(figure.panels[0].curves[0].y[i], 20 * std::log10(2 / std::hypot(1, w)), 1e-12);
        EXPECT_NEAR(figure.panels[1].curves[0].y[i], -std::atan(w) * kDegrees, 1e-12);
    }
    for (const Panel& panel : figure.panels) EXPECT_EQ(panel.x_range, std::pair(0.5, 2.0));
    EXPECT_EQ(message_text(figure.panels[0].curves[0].label), "etfe");
}

TEST(spectral_plot, values_without_errors_are_grey_points_that_are_not_unwrapped) {
    SpectralEstimate estimate = lag();
    estimate.response = ComplexVector{{Complex(0, 1), Complex(-1, 1), Complex(-1, -1), Complex(1, 0)}};
    const Figure figure = spectral_plot(estimate, Message("etfe"), {});
    for (const Panel& panel : figure.panels) {
        EXPECT_EQ(panel.curves[0].style, CurveStyle::kPoints);
        EXPECT_EQ(panel.curves[0].color, style::kGrayColor);
        EXPECT_EQ(panel.curves.size(), 1u);
    }
    EXPECT_NEAR((figure.panels[1].curves[0].y - Vector{{90, -225, -135, 0}}).norm(), 0, 1e-12);
}

TEST(spectral_plot, bands_hold_the_errors_of_first_order) {
    SpectralEstimate estimate = lag();
    estimate.std = Vector{{0.01, 0.02, 0.03, 0.04}};
    const Figure figure = spectral_plot(estimate, Message("spa"), {}, 0.99);
    for (std::size_t panel = 0; panel < 2; ++panel) {
        ASSERT_EQ(figure.panels[panel].curves.size(), 2u);
        const Curve &line = figure.panels[panel].curves[0], &band = figure.panels[panel].curves[1];
        EXPECT_EQ(line.style, CurveStyle::kLine);
        EXPECT_EQ(band.style, CurveStyle::kBand);
        EXPECT_EQ(message_text(band.label), "99 % confidence");
        const double unit = panel == 0 ? 20 / std::numbers::ln10 : kDegrees;
        for (Index i = 0; i < 4; ++i) {
            const double half = kQuantile * estimate.std[i] / std::abs(estimate.response[i]) * unit;
            EXPECT_NEAR(band.y_upper[i] - line.y[i], half, 1e-8);
            EXPECT_NEAR(line.y[i] - band.y[i], half, 1e-8);
        }
    }
}

TEST(spectral_plot, the_phase_has_a_gap_where_nothing_is_known_of_it) {
    SpectralEstimate estimate = lag();
    estimate.std = Vector::Constant(4, 0.01);
    estimate.std[2] = std::abs(estimate.response[2]) / kQuantile * 1.01;
    const Vector phase = spectral_plot(estimate, Message("spa"), {}).panels[1].curves[0].y;
    EXPECT_TRUE(std::isnan(phase[2]));
    EXPECT_NEAR(phase[3], -std::atan(2) * kDegrees, 1e-12);
    estimate.std[2] = std::abs(estimate.response[2]) / kQuantile * 0.99;
    EXPECT_FALSE(std::isnan(spectral_plot(estimate, Message("spa"), {}).panels[1].curves[0].y[2]));
}

TEST(spectral_plot, phase_unknown_at_all_frequencies_is_a_sentence) {
    SpectralEstimate estimate = lag();
    estimate.std = estimate.response.cwiseAbs() / kQuantile * 1.01;
    EXPECT_FALSE(has_known_phase(estimate, 0.99));
    EXPECT_TRUE(has_known_phase(estimate, 0.95));
    const Figure alone = spectral_plot(estimate, Message("spa"), {});
    alone.validate();
    EXPECT_EQ(alone.panels[0].curves.size(), 2u);  // magnitude and its band
    EXPECT_TRUE(alone.panels[1].curves.empty());
    ASSERT_EQ(alone.panels[1].annotations.size(), 1u);
    EXPECT_EQ(message_text(alone.panels[1].annotations[0].text), "The data do not determine the phase.");
    const Figure compared = spectral_plot(estimate, Message("spa"), {{Message("a"), kLag}});
    compared.validate();
    ASSERT_EQ(compared.panels[1].curves.size(), 1u);
    EXPECT_EQ(message_text(compared.panels[1].curves[0].label), "a");
    EXPECT_EQ(compared.panels[1].curves[0].color, 1);
}

TEST(spectral_plot, zero_response_is_a_sentence) {
    SpectralEstimate estimate = lag();
    estimate.response.setZero();
    estimate.std = Vector::Constant(4, 0.1);
    const Figure figure = spectral_plot(estimate, Message("spa"), {});
    figure.validate();
    EXPECT_TRUE(figure.panels[0].curves.empty());
    ASSERT_EQ(figure.panels[0].annotations.size(), 1u);
    EXPECT_EQ(message_text(figure.panels[0].annotations[0].text), "The estimated response is zero.");
}

TEST(spectral_plot, models_lie_over_the_estimate_in_colors_of_their_own) {
    SpectralEstimate estimate = lag();
    estimate.w = Vector{{0.25, 0.5, 1, 2}};
    for (Index i = 0; i < 4; ++i) estimate.response[i] = 2.0 / Complex(1, estimate.w[i]);
    estimate.std = Vector::Constant(4, 0.01);
    const Figure figure = spectral_plot(estimate, Message("spa"), {{Message("a"), kLag}, {Message("b"), kLag}});
    figure.validate();
    for (const Panel& panel : figure.panels) {
        EXPECT_EQ(panel.curves[1].color, 1);
        EXPECT_EQ(panel.curves[2].color, 2);
        EXPECT_EQ(panel.curves[1].x[0], 0.25);
        EXPECT_EQ(panel.curves[1].x.tail(1)[0], 2);
        EXPECT_NEAR(panel.curves[1].y[0], panel.curves[0].y[0], 1e-9);
        EXPECT_NEAR(panel.curves[1].y.tail(1)[0], panel.curves[0].y[3], 1e-9);
    }
}

TEST(spectral_plot, models_are_drawn_finely) {  // oracle: the height of a peak between two frequencies of the estimate
    SpectralEstimate estimate = lag();
    const TransferFunction peak(Vector{{1.0}}, Vector{{1.0, 0.05, 1.44}});
    const Figure figure = spectral_plot(estimate, Message("etfe"), {{Message("a"), peak}});
    EXPECT_NEAR(figure.panels[0].curves[1].y.maxCoeff(), 20 * std::log10(1 / (0.05 * 1.2)), 0.1);
}

TEST(spectral_plot, refuses_what_has_no_frequency_to_draw) {
    SpectralEstimate estimate;
    EXPECT_THROW(spectral_plot(estimate, Message("etfe"), {}), InvalidArgument);
    estimate.w = Vector::Zero(1);
    estimate.response = ComplexVector::Ones(1);
    EXPECT_THROW(spectral_plot(estimate, Message("etfe"), {}), InvalidArgument);
}

}  // namespace test_spectral_plot
}  // namespace dynlab
