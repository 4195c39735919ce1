#include "figures/curve_traces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "figures/panel_axes.h"

namespace dynlab::inline figures {
namespace {

constexpr double kResolution = 2.54 / 300;  // cm
constexpr double kFarOutside = 1000;        // cm; beyond the frame the exact position no longer matters
constexpr PagePoint kGapPoint = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

double on_page(const Axis& axis, double value, double length) {
    return std::clamp(axis.position(value) * length, -kFarOutside, kFarOutside);  // NaN passes through
}

Trace page_points(const PanelLayout& panel, const Vector& x, const Vector& y) {
    Trace trace(static_cast<std::size_t>(x.size()));
    for (Index i = 0; i < x.size(); ++i)
        trace[static_cast<std::size_t>(i)] = {on_page(panel.x, x[i], panel.box.width()),
                                              on_page(panel.y, y[i], panel.box.height())};
    return trace;
}

Trace held(const Trace& samples) {
    Trace path;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        path.push_back(samples[i]);
        if (i + 1 < samples.size() && !samples[i].gap() && !samples[i + 1].gap())
            path.push_back({samples[i + 1].x, samples[i].y});
    }
    return path;
}

Trace lone_samples(const Trace& trace) {
    Trace lone;
    for (std::size_t i = 0; i < trace.size(); ++i) {
        const bool left = i > 0 && !trace[i - 1].gap(), right = i + 1 < trace.size() && !trace[i + 1].gap();
        if (!trace[i].gap() && !left && !right) lone.push_back(trace[i]);
    }
    return lone;
}

/// Page height of the value zero, or of the frame's lower edge where the axis does not show zero.
double base_height(const PanelLayout& panel) {
    if (panel.y.log) return 0;
    return std::clamp(panel.y.position(0), 0.0, 1.0) * panel.box.height();
}

std::vector<Rectangle> bars_of(const Curve& curve, const PanelLayout& panel, const Trace& samples) {
    std::vector<Rectangle> bars;
    const double base = base_height(panel);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].gap()) continue;
        const auto [left, right] = bar_edges(curve.x, static_cast<Index>(i));
        const double begin =
            panel.x.log && !(left > 0) ? panel.x.low : left;  // as far to the left as there are numbers
        const Rectangle bar{on_page(panel.x, begin, panel.box.width()), std::min(base, samples[i].y),
                            on_page(panel.x, right, panel.box.width()), std::max(base, samples[i].y)};
        if (!std::isfinite(bar.left + bar.right)) continue;  // a neighbor that is no number leaves the width open
        const bool same_column = !bars.empty() && bar.right - bars.back().left < kResolution;
        if (same_column)  // bars thinner than a dot become one as tall as the tallest
            bars.back() = {bars.back().left, std::min(bars.back().bottom, bar.bottom), bar.right,
                           std::max(bars.back().top, bar.top)};
        else
            bars.push_back(bar);
    }
    return bars;
}

Trace stems_of(const Trace& points, double base) {
    Trace stems;
    for (const PagePoint& point : points) {
        stems.push_back({point.x, base});
        stems.push_back(point);
        stems.push_back(kGapPoint);
    }
    return stems;
}

}  // namespace

CurveTraces traces_of(const Curve& curve, const PanelLayout& panel) {
    const Trace samples = page_points(panel, curve.x, curve.y);
    CurveTraces traces;
    switch (curve.style) {
        case CurveStyle::kLine:
            traces.line = decimate_line(samples, kResolution);
            traces.points = decimate_points(lone_samples(samples), kResolution);
            break;
        case CurveStyle::kStairs:
            traces.line = decimate_line(held(samples), kResolution);
            traces.points = decimate_points(lone_samples(samples), kResolution);
            break;
        case CurveStyle::kLinePoints:
            traces.line = decimate_line(samples, kResolution);
            traces.points = decimate_points(samples, kResolution);
            break;
        case CurveStyle::kPoints:
            traces.points = decimate_points(samples, kResolution);
            break;
        case CurveStyle::kStems:
            traces.points = decimate_points(decimate_line(samples, kResolution), kResolution);
            traces.line = stems_of(traces.points, base_height(panel));
            break;
        case CurveStyle::kBars:
            traces.bars = bars_of(curve, panel, samples);
            break;
        case CurveStyle::kBand:
            std::tie(traces.lower, traces.upper) =
                decimate_band(samples, page_points(panel, curve.x, curve.y_upper), kResolution);
            break;
    }
    return traces;
}

}  // namespace dynlab::inline figures
