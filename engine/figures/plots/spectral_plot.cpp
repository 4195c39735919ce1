#include "figures/plots/spectral_plot.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "figures/confidence_band.h"
#include "figures/plots/bode_plot.h"
#include "figures/style.h"
#include "numerics/error.h"
#include "numerics/simulation/frequency_response.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline figures {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kMinDecibels = 20, kMinDegrees = 90;

/// Unwrapped over the frequencies where it is known, NaN at the others. Single values without errors are too wild to be
/// unwrapped and lie between -270 and 90 degrees.
Vector known_phase(const SpectralEstimate& estimate, double half_width) {
    const Index count = estimate.w.size();
    Vector phase = Vector::Constant(count, std::numeric_limits<double>::quiet_NaN());
    if (estimate.std.size() == 0) {
        for (Index i = 0; i < count; ++i) {
            const double angle = std::arg(estimate.response[i]) * kDegrees;
            phase[i] = angle > 90 ? angle - 360 : angle;
        }
        return phase;
    }
    std::vector<Index> known;
    for (Index i = 0; i < count; ++i)
        if (half_width * estimate.std[i] < std::abs(estimate.response[i])) known.push_back(i);
    const Vector unwrapped = phase_degrees_unwrapped(estimate.response(known));
    for (std::size_t i = 0; i < known.size(); ++i) phase[known[i]] = unwrapped[static_cast<Index>(i)];
    return phase;
}

Curve curve_of(const SpectralEstimate& estimate, const Vector& y, const Message& label) {
    Curve curve;
    curve.x = estimate.w;
    curve.y = y;
    curve.label = label;
    curve.color = 0;
    curve.dash = 0;
    if (estimate.std.size() == 0) {
        curve.style = CurveStyle::kPoints;
        curve.color = style::kGrayColor;
        curve.marker = 0;
    }
    return curve;
}

/// The curves of models from the first to the last frequency, in separate colors.
void add_models(Figure& figure, const std::vector<NamedModel>& models, double first, double last) {
    constexpr Index kModelPoints = 800;
    if (models.empty()) return;
    Figure theirs = bode_plot(
        models,
        Vector::LinSpaced(kModelPoints, std::log(first), std::log(last)).array().exp().max(first).min(last).matrix());
    for (std::size_t panel = 0; panel < 2; ++panel) {
        int color = 1;
        for (Curve& curve : theirs.panels[panel].curves) {
            if (curve.style != CurveStyle::kBand) curve.color = color++;
            if (curve.style != CurveStyle::kBand) figure.panels[panel].curves.push_back(std::move(curve));
        }
    }
}

}  // namespace

Figure spectral_plot(const SpectralEstimate& estimate, const Message& name, const std::vector<NamedModel>& models,
                     double level) {
    if (!(estimate.w.size() > 0) || !(estimate.w.maxCoeff() > 0))
        throw InvalidArgument("nothing to draw: no frequency is positive");
    const double width = normal_half_width(level);
    auto [magnitude, phase] = frequency_panels();
    magnitude.curves = {curve_of(estimate, magnitude_db(estimate.response), name)};
    phase.curves = {curve_of(estimate, known_phase(estimate, width), name)};
    Figure figure;
    figure.rows = 2;
    figure.panels = {std::move(magnitude), std::move(phase)};
    double first = std::numeric_limits<double>::infinity();
    for (const double value : estimate.w)
        if (value > 0) first = std::min(first, value);
    add_models(figure, models, first, estimate.w.maxCoeff());
    const std::size_t lines = 1 + models.size();
    if (estimate.std.size() > 0) {
        const Vector relative = width * estimate.std.cwiseQuotient(estimate.response.cwiseAbs());
        add_confidence_band(figure.panels[0], 0, 20 / std::numbers::ln10 * relative, level);
        add_confidence_band(figure.panels[1], 0, kDegrees * relative, level);
        limit_to_readable(figure.panels[0], lines, kMinDecibels);
        limit_to_readable(figure.panels[1], lines, kMinDegrees);
    }
    choose_phase_axis(figure.panels[1]);
    if (first < estimate.w.maxCoeff())
        for (Panel& panel : figure.panels) panel.x_range = {first, estimate.w.maxCoeff()};
    return figure;
}

}  // namespace dynlab::inline figures
