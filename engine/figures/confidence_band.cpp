#include "figures/confidence_band.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "figures/style.h"

namespace dynlab {

std::string confidence_text(double level) {
    return fmt::format("{:.4g} % confidence", 100 * level);
}

void add_confidence_band(Panel& panel, std::size_t line, const Vector& half_width, double level) {
    const auto is_band = [](const Curve& curve) { return curve.style == CurveStyle::kBand; };
    const bool first = std::none_of(panel.curves.begin(), panel.curves.end(), is_band);
    const Curve& centre = panel.curves[line];
    Curve band;
    band.style = CurveStyle::kBand;
    band.x = centre.x;
    band.colour = centre.colour;
    const auto width =
        half_width.array().isFinite().select(half_width.array(), std::numeric_limits<double>::quiet_NaN());
    band.y = centre.y.array() - width;
    band.y_upper = centre.y.array() + width;
    if (!(band.y.array().isFinite() && band.y_upper.array().isFinite()).any()) return;
    if (first) band.label = confidence_text(level);
    panel.curves.push_back(std::move(band));
}

void fix_colours(Panel& panel) {
    for (std::size_t i = 0; i < panel.curves.size(); ++i)
        if (!panel.curves[i].colour) panel.curves[i].colour = static_cast<int>(i) % style::kGreyColour;
}

}  // namespace dynlab
