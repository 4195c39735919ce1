#include "figures/plots/history_plot.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "figures/confidence_band.h"
#include "figures/figure_text.h"
#include "figures/style.h"
#include "numerics/error.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline figures {
namespace {

constexpr double kMargin = 0.3;  // of the settled curve's range, shown above and below it

/// Largest and smallest of the later two thirds, where the estimate has settled, and of the truth.
std::pair<double, double> settled_range(const Vector& values, const Vector& half_width, const Vector& truth) {
    double low = kInfinity, high = -kInfinity;
    for (Index k = values.size() / 3; k < values.size(); ++k) {
        if (!std::isfinite(values[k])) continue;
        const double width = std::isfinite(half_width[k]) ? half_width[k] : 0;
        low = std::min(low, values[k] - width);
        high = std::max(high, values[k] + width);
    }
    for (const double value : truth) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return {low, high};
}

Panel panel_of(const ParameterHistory& history, Index parameter, const std::string& name, const Vector& truth,
               double level) {
    Panel panel;
    panel.y_label = Message::verbatim(with_marked_indices(name));
    Curve curve;
    curve.x = history.t;
    curve.y = history.theta.col(parameter);
    curve.color = 0;
    curve.dash = 0;
    curve.label = Message("estimate");
    panel.curves.push_back(std::move(curve));
    if (truth.size() > 0) {
        Curve line;
        line.x = Vector::LinSpaced(std::max<Index>(truth.size(), 2), history.t[0], history.t[history.t.size() - 1]);
        line.y = truth.size() == 1 ? Vector(Vector::Constant(2, truth[0])) : truth;
        line.color = style::kGrayColor;
        line.dash = 1;
        line.label = Message("true value");
        panel.curves.push_back(std::move(line));
    }
    const Vector half_width = normal_half_width(level) * history.std.col(parameter);
    const auto [low, high] = settled_range(history.theta.col(parameter), half_width, truth);
    const double margin = kMargin * std::max(high - low, 1e-9 * std::max(std::abs(low), std::abs(high)));
    if (high >= low) panel.y_range = {low - margin, high + margin};
    add_confidence_band(panel, 0, half_width, level);
    return panel;
}

}  // namespace

Figure history_plot(const ParameterHistory& history, const std::vector<std::string>& names,
                    const std::map<std::string, Vector>& truth, double level) {
    if (history.t.size() == 0) throw InvalidArgument("no history to draw");
    for (const auto& [name, values] : truth)
        if (std::find(names.begin(), names.end(), name) == names.end())
            throw InvalidArgument("'{}' has a true value but is not a parameter; the parameters are {}", name,
                                  listed(names));
    Figure figure;
    for (Index i = 0; i < history.theta.cols(); ++i) {
        const std::string& name = names[static_cast<std::size_t>(i)];
        const auto known = truth.find(name);
        figure.panels.push_back(panel_of(history, i, name, known == truth.end() ? Vector() : known->second, level));
    }
    figure.rows = static_cast<int>(figure.panels.size());
    figure.panels.back().x_label = axis_label(Message("time"), "s");
    return figure;
}

}  // namespace dynlab::inline figures
