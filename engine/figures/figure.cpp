#include "figures/figure.h"

#include <fmt/format.h>

#include <cmath>

#include "base/number_text.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

std::string numbered_name(const std::string& kind, std::size_t number, const std::string& label) {
    return label.empty() ? fmt::format("{} {}", kind, number) : fmt::format("{} {} (\"{}\")", kind, number, label);
}

void check_range(const std::optional<std::pair<double, double>>& range, bool log, const char* axis,
                 const std::string& panel) {
    if (!range) return;
    const auto [low, high] = *range;
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
        throw InvalidArgument(fmt::format(
            "{}: the {} range must run from a smaller to a larger number, not from {} to {}", panel, axis, low, high));
    if (log && low <= 0)
        throw InvalidArgument(fmt::format(
            "{}: the {} range of a logarithmic axis must be positive, but it starts at {}", panel, axis, low));
}

bool drawable(double value, bool log) {
    return std::isfinite(value) && (!log || value > 0);
}

void check_curve(const Curve& curve, const Panel& panel, const std::string& where) {
    if (curve.x.size() != curve.y.size())
        throw InvalidArgument(fmt::format("{}: x and y must have the same length, but x has {} and y has {}", where,
                                          counted(curve.x.size(), "value"), curve.y.size()));
    if (curve.style == CurveStyle::kBand && curve.y_upper.size() != curve.y.size())
        throw InvalidArgument(
            fmt::format("{}: the upper edge of a band needs as many values as the lower one, {}, not {}", where,
                        curve.y.size(), curve.y_upper.size()));
    if (!std::isfinite(curve.line_width) || curve.line_width <= 0)
        throw InvalidArgument(
            fmt::format("{}: the line width must be a positive number of points, not {}", where, curve.line_width));
    for (Index i = 0; i < curve.x.size(); ++i)
        if (drawable(curve.x[i], panel.log_x) && drawable(curve.y[i], panel.log_y)) return;
    throw InvalidArgument(fmt::format("{}: there is nothing to draw: of {} none is finite{}", where,
                                      counted(curve.x.size(), "sample"),
                                      panel.log_x || panel.log_y ? " and positive on the logarithmic axis" : ""));
}

void check_tick_step(const std::optional<double>& step, const char* axis, const std::string& where) {
    if (step && !(std::isfinite(*step) && *step > 0))
        throw InvalidArgument(
            fmt::format("{}: the step of the numbers on {} must be positive, not {}", where, axis, *step));
}

void check_panel(const Panel& panel, const std::string& where) {
    check_range(panel.x_range, panel.log_x, "x", where);
    check_range(panel.y_range, panel.log_y, "y", where);
    check_tick_step(panel.x_tick_step, "x", where);
    check_tick_step(panel.y_tick_step, "y", where);
    for (std::size_t i = 0; i < panel.curves.size(); ++i)
        check_curve(panel.curves[i], panel,
                    fmt::format("{}, {}", where, numbered_name("curve", i + 1, panel.curves[i].label)));
    for (const ReferenceLine& line : panel.references)
        if (!drawable(line.at, line.horizontal ? panel.log_y : panel.log_x))
            throw InvalidArgument(fmt::format("{}: a reference line cannot be drawn at {}", where, line.at));
    for (const Annotation& mark : panel.annotations)
        if (!drawable(mark.x, panel.log_x) || !drawable(mark.y, panel.log_y))
            throw InvalidArgument(
                fmt::format("{}: the mark \"{}\" cannot be placed at ({}, {})", where, mark.text, mark.x, mark.y));
    for (const Arrow& arrow : panel.arrows)
        if (!drawable(arrow.x0, panel.log_x) || !drawable(arrow.x1, panel.log_x) || !drawable(arrow.y0, panel.log_y) ||
            !drawable(arrow.y1, panel.log_y))
            throw InvalidArgument(fmt::format("{}: the arrow \"{}\" cannot be drawn from ({}, {}) to ({}, {})", where,
                                              arrow.text, arrow.x0, arrow.y0, arrow.x1, arrow.y1));
}

void check_motion(const Motion& motion, const std::vector<Panel>& panels) {
    motion.rig.validate();
    const std::size_t curves = (motion.measured ? 1 : 0) + (motion.simulated ? 1 : 0);
    for (std::size_t k = 0; k < motion.rig.parts.size(); ++k) {
        const std::size_t place = motion.picture + 1 + k;
        if (place >= panels.size() || panels[place].curves.size() < curves)
            throw InvalidArgument(
                fmt::format("panel {} must show the {} that moves the rig", place + 1, motion.rig.parts[k].signal));
    }
}

}  // namespace

void Figure::validate() const {
    constexpr int kMostRows = 100;
    if (rows < 1 || columns < 1 || rows > kMostRows || columns > kMostRows)
        throw InvalidArgument(
            fmt::format("a figure needs between one and {} rows and columns, not {} x {}", kMostRows, rows, columns));
    if (panels.empty()) throw InvalidArgument("a figure needs at least one panel, but it has none");
    if (panels.size() > static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns))
        throw InvalidArgument(
            fmt::format("a figure of {} x {} panels cannot hold {} panels", rows, columns, panels.size()));
    if (!(width_cm >= 3 && width_cm <= 200))
        throw InvalidArgument(fmt::format("the width of a figure must lie between 3 and 200 cm, not {}", width_cm));
    if (!(height_cm == 0 || (height_cm >= 3 && height_cm <= 200)))
        throw InvalidArgument(fmt::format(
            "the height of a figure must lie between 3 and 200 cm, or be 0 to have it chosen, not {}", height_cm));
    for (std::size_t i = 0; i < panels.size(); ++i)
        check_panel(panels[i], numbered_name("panel", i + 1, panels[i].title));
    if (motion) check_motion(*motion, panels);
}

}  // namespace dynlab::inline figures
