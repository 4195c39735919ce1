#include "figures/confidence_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "figures/axis.h"
#include "figures/style.h"

namespace dynlab::inline figures {

Message confidence_text(double level) {
    return Message("{} % confidence", significant(100 * level, 4));
}

void add_confidence_band(Panel& panel, std::size_t line, const Vector& half_width, double level,
                         double max_half_width) {
    const auto is_band = [](const Curve& curve) { return curve.style == CurveStyle::kBand; };
    const bool first = std::none_of(panel.curves.begin(), panel.curves.end(), is_band);
    const Curve& center = panel.curves[line];
    Curve band;
    band.style = CurveStyle::kBand;
    band.x = center.x;
    band.color = center.color;
    band.dash = center.dash;
    const auto width =
        (half_width.array() <= max_half_width).select(half_width.array(), std::numeric_limits<double>::quiet_NaN());
    band.y = center.y.array() - width;
    band.y_upper = center.y.array() + width;
    if (!(band.y.array().isFinite() && band.y_upper.array().isFinite()).any()) return;
    if (first) band.label = confidence_text(level);
    panel.curves.push_back(std::move(band));
}

void limit_to_readable(Panel& panel, std::size_t lines, double min_padding) {
    double low = std::numeric_limits<double>::infinity(), high = -low, band_low = low, band_high = high;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        const Curve& curve = panel.curves[i];
        for (Index k = 0; k < curve.y.size(); ++k) {
            if (!std::isfinite(curve.y[k])) continue;
            const double upper = curve.style == CurveStyle::kBand ? curve.y_upper[k] : curve.y[k];
            if (i < lines) low = std::min(low, curve.y[k]), high = std::max(high, upper);
            band_low = std::min(band_low, curve.y[k]), band_high = std::max(band_high, upper);
        }
    }
    const double padding = std::max(0.5 * (high - low), min_padding);
    if (band_low >= low - padding && band_high <= high + padding) return;
    panel.y_range = {std::max(band_low, low - padding), std::min(band_high, high + padding)};
}

void fix_colors(Panel& panel) {
    for (std::size_t i = 0; i < panel.curves.size(); ++i) style::fix_appearance(panel.curves[i], static_cast<int>(i));
}

void choose_phase_axis(Panel& phase) {
    constexpr double kMin = 60;  // degrees shown
    constexpr int kMinNumbers = 4;
    Extent extent(false);
    for (const Curve& curve : phase.curves) {
        extent.include(curve.y);
        extent.include(curve.y_upper);
    }
    auto [low, high] = phase.y_range.value_or(extent.padded(0.06));
    if (const double lacking = kMin - (high - low); lacking > 0)
        phase.y_range = {low -= 0.5 * lacking, high += 0.5 * lacking};
    phase.y_tick_step = 15;
    double step = 30;
    while (std::floor(high / step) - std::ceil(low / step) + 1 >= kMinNumbers) {
        phase.y_tick_step = step;
        step = step == 30 ? 45 : 2 * step;
    }
}

}  // namespace dynlab::inline figures
