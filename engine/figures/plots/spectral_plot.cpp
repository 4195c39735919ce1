#include "figures/plots/spectral_plot.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "figures/axis.h"
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

bool has_values(const Curve& curve) {
    return curve.y.array().isFinite().any();
}

/// A sentence in place of an estimate without values to draw, at the frequency `w`.
void add_note(Panel& panel, double w, double half_height, const Message& sentence) {
    double y = 0;
    if (panel.curves.empty()) {
        panel.y_range = {-half_height, half_height};
    } else {
        Extent extent(false);
        for (const Curve& curve : panel.curves) extent.include(curve.y);
        const auto [low, high] = extent.padded(0);
        y = 0.5 * (low + high);
    }
    panel.annotations.push_back({w, y, sentence, false});
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

bool has_known_phase(const SpectralEstimate& estimate, double level) {
    return known_phase(estimate, normal_half_width(level)).array().isFinite().any();
}

Figure spectral_plot(const SpectralEstimate& estimate, const Message& name, const std::vector<NamedModel>& models,
                     double level) {
    if (!(estimate.w.size() > 0) || !(estimate.w.maxCoeff() > 0))
        throw InvalidArgument("nothing to draw: no frequency is positive");
    const double width = normal_half_width(level);
    auto [magnitude, phase] = frequency_panels();
    const Curve levels = curve_of(estimate, magnitude_db(estimate.response), name);
    const Curve angles = curve_of(estimate, known_phase(estimate, width), name);
    const bool has_magnitude = has_values(levels), has_phase = has_values(angles);
    if (has_magnitude) magnitude.curves = {levels};
    if (has_phase) phase.curves = {angles};
    Figure figure;
    figure.rows = 2;
    figure.panels = {std::move(magnitude), std::move(phase)};
    double first = std::numeric_limits<double>::infinity();
    for (const double value : estimate.w)
        if (value > 0) first = std::min(first, value);
    const double last = estimate.w.maxCoeff(), middle = std::sqrt(first * last);
    add_models(figure, models, first, last);
    if (estimate.std.size() > 0) {
        const Vector relative = width * estimate.std.cwiseQuotient(estimate.response.cwiseAbs());
        if (has_magnitude) add_confidence_band(figure.panels[0], 0, 20 / std::numbers::ln10 * relative, level);
        if (has_phase) add_confidence_band(figure.panels[1], 0, kDegrees * relative, level);
        limit_to_readable(figure.panels[0], models.size() + (has_magnitude ? 1 : 0), kMinDecibels);
        limit_to_readable(figure.panels[1], models.size() + (has_phase ? 1 : 0), kMinDegrees);
    }
    if (!has_magnitude) add_note(figure.panels[0], middle, kMinDecibels, Message("The estimated response is zero."));
    if (!has_phase)
        add_note(figure.panels[1], middle, 2 * kMinDegrees, Message("The data do not determine the phase."));
    choose_phase_axis(figure.panels[1]);
    if (first < last)
        for (Panel& panel : figure.panels) panel.x_range = {first, last};
    return figure;
}

}  // namespace dynlab::inline figures
