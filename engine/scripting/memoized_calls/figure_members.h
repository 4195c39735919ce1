#pragma once
#include <tuple>

#include "figures/figure.h"
#include "scripting/memoized_calls/class_members.h"

namespace dynlab::inline scripting {

/// Of figures; see class_members.h.

template <Is<Curve> T>
auto members(T& object) {
    auto& [x, y, y_upper, style, label, colour, dash, line_width, marker] = object;
    return std::tie(x, y, y_upper, style, label, colour, dash, line_width, marker);
}

template <Is<ReferenceLine> T>
auto members(T& object) {
    auto& [horizontal, at, label, dash] = object;
    return std::tie(horizontal, at, label, dash);
}

template <Is<Annotation> T>
auto members(T& object) {
    auto& [x, y, text, marker] = object;
    return std::tie(x, y, text, marker);
}

template <Is<Arrow> T>
auto members(T& object) {
    auto& [x0, y0, x1, y1, text, both_heads] = object;
    return std::tie(x0, y0, x1, y1, text, both_heads);
}

template <Is<Panel> T>
auto members(T& object) {
    auto& [title, x_label, y_label, log_x, log_y, x_range, y_range, x_tick_step, y_tick_step, equal_axes, legend,
           curves, references, annotations, arrows] = object;
    return std::tie(title, x_label, y_label, log_x, log_y, x_range, y_range, x_tick_step, y_tick_step, equal_axes,
                    legend, curves, references, annotations, arrows);
}

template <Is<Figure> T>
auto members(T& object) {
    auto& [rows, columns, panels, title, width_cm, height_cm] = object;
    return std::tie(rows, columns, panels, title, width_cm, height_cm);
}

}  // namespace dynlab::inline scripting
