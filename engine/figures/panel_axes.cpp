#include "figures/panel_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "figures/style.h"

namespace dynlab::inline figures {
namespace {

using Range = std::pair<double, double>;

bool has_style(const Panel& panel, std::initializer_list<CurveStyle> styles) {
    return std::ranges::any_of(
        panel.curves, [&](const Curve& curve) { return std::ranges::find(styles, curve.style) != styles.end(); });
}

Range x_range_of(const Panel& panel) {
    if (panel.x_range) return *panel.x_range;
    Extent extent(panel.log_x);
    for (const Curve& curve : panel.curves) {
        extent.include(curve.x);
        if (curve.style != CurveStyle::kBars) continue;
        for (const Index i : {Index{0}, curve.x.size() - 1}) {
            const auto [left, right] = bar_edges(curve.x, i);
            extent.include(left), extent.include(right);
        }
    }
    for (const ReferenceLine& line : panel.references)
        if (!line.horizontal) extent.include(line.at);
    for (const Annotation& mark : panel.annotations) extent.include(mark.x);
    for (const Arrow& arrow : panel.arrows) extent.include(arrow.x0), extent.include(arrow.x1);
    const bool markers =
        has_style(panel, {CurveStyle::kPoints, CurveStyle::kLinePoints, CurveStyle::kStems, CurveStyle::kBars});
    return extent.padded(panel.equal_axes ? 0.08 : markers ? 0.03 : 0.0);
}

Range y_range_of(const Panel& panel, Range x_range) {
    if (panel.y_range) return *panel.y_range;
    const auto shown = [&](double x) { return x >= x_range.first && x <= x_range.second; };
    Extent extent(panel.log_y);
    for (const Curve& curve : panel.curves)
        for (Index i = 0; i < curve.y.size(); ++i) {
            if (!shown(curve.x[i])) continue;
            extent.include(curve.y[i]);
            if (curve.style == CurveStyle::kBand) extent.include(curve.y_upper[i]);
        }
    const bool from_zero = !panel.log_y && has_style(panel, {CurveStyle::kBars, CurveStyle::kStems});
    if (from_zero) extent.include(0);
    for (const ReferenceLine& line : panel.references)
        if (line.horizontal) extent.include(line.at);
    for (const Annotation& mark : panel.annotations) extent.include(mark.y);
    for (const Arrow& arrow : panel.arrows) extent.include(arrow.y0), extent.include(arrow.y1);
    Range range = extent.padded(panel.equal_axes ? 0.08 : 0.06);
    if (from_zero && extent.padded(0).first == 0) range.first = 0;
    return range;
}

void widen(Range& range, double span) {
    const double middle = 0.5 * (range.first + range.second);
    range = {middle - 0.5 * span, middle + 0.5 * span};
}

/// The numbers of x are side by side with space between them, those of y one above the other.
struct AxisLength {
    double cm;
    bool upright;

    bool holds(const Axis& axis) const {
        double total = 0;
        for (const Tick& tick : axis.ticks)
            total += upright ? style::kTickLine : text_width(tick.label, style::kTickSize) + 0.3;
        return total <= cm;
    }
};

/// Numbers at every second, third, ... tick only, so that they fit; the others stay as short ticks. `axis` itself when
/// not even two numbers fit.
Axis thinned(const Axis& axis, AxisLength length) {
    const std::size_t count = axis.ticks.size();
    for (std::size_t stride = 2; stride < count; ++stride)
        for (std::size_t first = 0; first < stride && first + stride < count; ++first) {
            Axis sparse = axis;
            sparse.ticks.clear();
            for (std::size_t i = 0; i < count; ++i)
                if (i % stride == first)
                    sparse.ticks.push_back(axis.ticks[i]);
                else
                    sparse.minor.push_back(axis.ticks[i].value);
            if (length.holds(sparse)) return sparse;
        }
    return axis;
}

constexpr std::size_t kMinNumbers = 4;

/// The coarsest axis with four numbers, else that with most of those that hold their numbers; steps are 1, 2, 2.5 or 5
/// times a power of ten.
Axis finer_axis(const Axis& axis, AxisLength length) {
    Axis best = axis;
    const Range range = {axis.low, axis.high};
    const double decade = std::pow(10.0, std::ceil(std::log10(range.second - range.first)));
    for (const double scale : {1.0, 0.1})
        for (const double factor : {1.0, 0.5, 0.25, 0.2}) {
            if (best.ticks.size() >= kMinNumbers) return best;
            Axis candidate = make_axis(range, false, 20, factor * scale * decade);
            if (candidate.ticks.size() > best.ticks.size() && length.holds(candidate)) best = std::move(candidate);
        }
    return best;
}

/// As many numbers as fit: four if there is room, and at least two even in a small panel, because one number shows no
/// scale. A requested step is never divided.
Axis fitted_axis(Range range, bool log, double count, std::optional<double> step, AxisLength length) {
    constexpr double kMinCount = 1.2, kMax = 20;
    Axis axis = make_axis(range, log, count, step);
    while (!step && !length.holds(axis) && count >= kMinCount) axis = make_axis(range, log, count *= 0.75);
    if (!step && !log && length.holds(axis)) axis = finer_axis(axis, length);
    Axis finer = axis;
    while (!step && finer.ticks.size() < 2 && count < kMax) finer = make_axis(range, log, count *= 1.5);
    if (!length.holds(finer)) finer = thinned(finer, length);
    return length.holds(finer) ? finer : axis;
}

}  // namespace

std::pair<double, double> bar_edges(const Vector& centers, Index i) {
    const Index last = centers.size() - 1;
    if (last < 1) return {centers[i] - 0.5, centers[i] + 0.5};
    const auto half_between = [&](Index left) {
        const double half = 0.5 * centers[left + 1] - 0.5 * centers[left];
        return std::isfinite(half) ? half : 0.5;
    };
    const double before = half_between(std::max<Index>(i - 1, 0)), after = half_between(std::min(i, last - 1));
    const double largest = std::numeric_limits<double>::max();
    return {std::max(centers[i] - before, -largest), std::min(centers[i] + after, largest)};
}

void choose_axes(const Panel& panel, double width, double height, Axis& x, Axis& y) {
    Range x_range = usable_range(x_range_of(panel), panel.log_x);
    Range y_range = usable_range(y_range_of(panel, x_range), panel.log_y);
    if (panel.equal_axes && !panel.log_x && !panel.log_y) {
        const double scale =
            std::max((x_range.second - x_range.first) / width, (y_range.second - y_range.first) / height);
        widen(x_range, scale * width);
        widen(y_range, scale * height);
    }
    x = fitted_axis(x_range, panel.log_x, std::max(2.0, width / 1.4), panel.x_tick_step, {width, false});
    y = fitted_axis(y_range, panel.log_y, std::max(2.0, height / 0.75), panel.y_tick_step, {height, true});
}

}  // namespace dynlab::inline figures
