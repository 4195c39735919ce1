#include "figures/figure.h"

#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

/// Which panel or curve: its number, and its title or label.
Message numbered_name(std::size_t number, const Message& label) {
    return label.empty() ? Message("{}", number) : Message("{} (\"{}\")", number, label);
}

/// As the caller gave it.
Number as_given(double value) {
    return significant(value, 15);
}

void check_range(const std::optional<std::pair<double, double>>& range, bool log, const char* axis,
                 const Message& panel) {
    if (!range) return;
    const auto [low, high] = *range;
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
        throw InvalidArgument("panel {}: the {} range must run from a smaller to a larger number, not from {} to {}",
                              panel, axis, as_given(low), as_given(high));
    if (log && low <= 0)
        throw InvalidArgument("panel {}: the {} range of a logarithmic axis must be positive, but it starts at {}",
                              panel, axis, as_given(low));
}

bool drawable(double value, bool log) {
    return std::isfinite(value) && (!log || value > 0);
}

void check_curve(const Curve& curve, const Panel& panel, const Message& name_of_panel, const Message& name) {
    if (curve.x.size() != curve.y.size())
        throw InvalidArgument("panel {}, curve {}: x and y must have the same length, but x has {} and y has {}",
                              name_of_panel, name, plural(curve.x.size(), "{} value", "{} values"), curve.y.size());
    if (curve.style == CurveStyle::kBand && curve.y_upper.size() != curve.y.size())
        throw InvalidArgument(
            "panel {}, curve {}: the edges of a band must have the same number of values, but the lower edge has {} "
            "and the upper edge has {}",
            name_of_panel, name, curve.y.size(), curve.y_upper.size());
    if (!std::isfinite(curve.line_width) || curve.line_width <= 0)
        throw InvalidArgument("panel {}, curve {}: the line width must be a positive number of points, not {}",
                              name_of_panel, name, as_given(curve.line_width));
    for (Index i = 0; i < curve.x.size(); ++i)
        if (drawable(curve.x[i], panel.log_x) && drawable(curve.y[i], panel.log_y)) return;
    const Message samples = plural(curve.x.size(), "{} sample", "{} samples");
    if (panel.log_x || panel.log_y)
        throw InvalidArgument(
            "panel {}, curve {} cannot be drawn: it has {}, but none is finite and positive on the logarithmic axis",
            name_of_panel, name, samples);
    throw InvalidArgument("panel {}, curve {} cannot be drawn: it has {}, but none is finite", name_of_panel, name,
                          samples);
}

void check_tick_step(const std::optional<double>& step, const char* axis, const Message& panel) {
    if (step && !(std::isfinite(*step) && *step > 0))
        throw InvalidArgument("panel {}: the tick spacing on the {}-axis must be positive, not {}", panel, axis,
                              as_given(*step));
}

void check_panel(const Panel& panel, const Message& name) {
    check_range(panel.x_range, panel.log_x, "x", name);
    check_range(panel.y_range, panel.log_y, "y", name);
    check_tick_step(panel.x_tick_step, "x", name);
    check_tick_step(panel.y_tick_step, "y", name);
    for (std::size_t i = 0; i < panel.curves.size(); ++i)
        check_curve(panel.curves[i], panel, name, numbered_name(i + 1, panel.curves[i].label));
    for (const ReferenceLine& line : panel.references)
        if (!drawable(line.at, line.horizontal ? panel.log_y : panel.log_x))
            throw InvalidArgument(
                "panel {}: a reference line cannot be drawn at {}. Positions must be finite, and positive on a "
                "logarithmic axis",
                name, as_given(line.at));
    for (const Annotation& mark : panel.annotations)
        if (!drawable(mark.x, panel.log_x) || !drawable(mark.y, panel.log_y))
            throw InvalidArgument(
                "panel {}: the mark \"{}\" cannot be placed at ({}, {}). Positions must be finite, and positive on a "
                "logarithmic axis",
                name, mark.text, as_given(mark.x), as_given(mark.y));
    for (const Arrow& arrow : panel.arrows)
        if (!drawable(arrow.x0, panel.log_x) || !drawable(arrow.x1, panel.log_x) || !drawable(arrow.y0, panel.log_y) ||
            !drawable(arrow.y1, panel.log_y))
            throw InvalidArgument(
                "panel {}: the arrow \"{}\" cannot be drawn from ({}, {}) to ({}, {}). Positions must be finite, and "
                "positive on a logarithmic axis",
                name, arrow.text, as_given(arrow.x0), as_given(arrow.y0), as_given(arrow.x1), as_given(arrow.y1));
}

void check_motion(const Motion& motion, const std::vector<Panel>& panels) {
    motion.plant.validate();
    const std::size_t curves = (motion.measured ? 1 : 0) + (motion.simulated ? 1 : 0);
    for (std::size_t k = 0; k < motion.plant.parts.size(); ++k) {
        const std::size_t place = motion.picture + 1 + k;
        if (place >= panels.size() || panels[place].curves.size() < curves)
            throw InvalidArgument("panel {} must show the signal {}, which moves the animated plant", place + 1,
                                  motion.plant.parts[k].signal);
    }
}

}  // namespace

void Figure::validate() const {
    constexpr int kMaxRowCount = 100;
    if (rows < 1 || columns < 1 || rows > kMaxRowCount || columns > kMaxRowCount)
        throw InvalidArgument("a figure needs 1 to {} rows and columns, not {} x {}", kMaxRowCount, rows, columns);
    if (panels.empty()) throw InvalidArgument("a figure needs at least one panel, but it has none");
    if (panels.size() > static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns))
        throw InvalidArgument("a figure of {} x {} panels cannot contain {} panels", rows, columns, panels.size());
    if (!(width_cm >= 3 && width_cm <= 200))
        throw InvalidArgument("the width of a figure must be from 3 to 200 cm, not {}", as_given(width_cm));
    if (!(height_cm == 0 || (height_cm >= 3 && height_cm <= 200)))
        throw InvalidArgument("the height of a figure must be from 3 to 200 cm, or 0 for an automatic height, not {}",
                              as_given(height_cm));
    for (std::size_t i = 0; i < panels.size(); ++i) check_panel(panels[i], numbered_name(i + 1, panels[i].title));
    if (motion) check_motion(*motion, panels);
}

}  // namespace dynlab::inline figures
