#include "figures/plots/profile_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "figures/style.h"

namespace dynlab::inline figures {
namespace {

constexpr double kShownRise = 4;  // times the level

Curve rise_curve(const Profile& profile, double top) {
    std::vector<double> x, y;
    for (Index i = 0; i < profile.grid.size(); ++i) {
        if (!(profile.rise[i] <= top)) continue;
        x.push_back(profile.grid[i]);
        y.push_back(profile.rise[i]);
    }
    Curve curve;
    curve.x = Vector::Map(x.data(), static_cast<Index>(x.size()));
    curve.y = Vector::Map(y.data(), static_cast<Index>(y.size()));
    curve.style = CurveStyle::kLinePoints;
    curve.line_width = 0.7;
    curve.color = 0;
    curve.label = Message("other parameters refitted");
    return curve;
}

Curve parabola(const Profile& profile, double low, double high) {
    constexpr Index kPoints = 101;
    Curve curve;
    curve.x = Vector::LinSpaced(kPoints, low, high);
    curve.y = ((curve.x.array() - profile.estimate) / profile.std).square();
    curve.color = style::kGrayColor;
    curve.dash = 1;
    curve.label = Message("from the standard error");
    return curve;
}

}  // namespace

Figure profile_plot(const Profile& profile, const std::string& unit) {
    const double top = std::max(kShownRise * profile.level, 1.5 * profile.rise.minCoeff());
    Panel panel;
    panel.curves.push_back(rise_curve(profile, top));
    const Vector& x = panel.curves.front().x;
    if (std::isfinite(profile.std) && profile.std > 0 && x.size() > 1)
        panel.curves.push_back(parabola(profile, x.minCoeff(), x.maxCoeff()));
    panel.references.push_back({true, profile.level, {}, 1});
    for (const auto& end : {profile.low, profile.high})
        if (end) panel.references.push_back({false, *end, {}, 2});
    panel.y_range = {-0.02 * top, top};
    panel.x_label = axis_label(Message::verbatim(profile.name), unit);
    panel.y_label = Message("increase of the loss, N ln(S/S_{min})");
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
