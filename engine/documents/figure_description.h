#pragma once
#include "data_io/values/described.h"
#include "figures/figure.h"

namespace dynlab::inline documents {

/// Figures as data_io/values/described.h stores them.

constexpr std::array<const char*, 7> names_of(CurveStyle) {
    return {"line", "points", "line_points", "stairs", "stems", "bars", "band"};
}

constexpr std::array<const char*, 4> names_of(LegendPlace) {
    return {"automatic", "above", "right", "none"};
}

template <Is<Curve> T, class V>
void describe(T& object, V& member) {
    auto& [x, y, y_upper, style, label, colour, dash, line_width, marker] = object;
    member("x", x), member("y", y), member("y_upper", y_upper), member("style", style), member("label", label);
    member("colour", colour), member("dash", dash), member("line_width", line_width), member("marker", marker);
}

template <Is<ReferenceLine> T, class V>
void describe(T& object, V& member) {
    auto& [horizontal, at, label, dash] = object;
    member("horizontal", horizontal), member("at", at), member("label", label), member("dash", dash);
}

template <Is<Annotation> T, class V>
void describe(T& object, V& member) {
    auto& [x, y, text, marker] = object;
    member("x", x), member("y", y), member("text", text), member("marker", marker);
}

template <Is<Arrow> T, class V>
void describe(T& object, V& member) {
    auto& [x0, y0, x1, y1, text, both_heads] = object;
    member("x0", x0), member("y0", y0), member("x1", x1), member("y1", y1);
    member("text", text), member("both_heads", both_heads);
}

template <Is<Panel> T, class V>
void describe(T& object, V& member) {
    auto& [title, x_label, y_label, log_x, log_y, x_range, y_range, x_tick_step, y_tick_step, equal_axes, legend,
           curves, references, annotations, arrows] = object;
    member("title", title), member("x_label", x_label), member("y_label", y_label);
    member("log_x", log_x), member("log_y", log_y), member("x_range", x_range), member("y_range", y_range);
    member("x_tick_step", x_tick_step), member("y_tick_step", y_tick_step), member("equal_axes", equal_axes);
    member("legend", legend), member("curves", curves), member("references", references);
    member("annotations", annotations), member("arrows", arrows);
}

template <Is<Figure> T, class V>
void describe(T& object, V& member) {
    auto& [rows, columns, panels, title, width_cm, height_cm] = object;
    member("rows", rows), member("columns", columns), member("panels", panels), member("title", title);
    member("width_cm", width_cm), member("height_cm", height_cm);
}

inline void check_value(const Figure& figure, const ValueLimits&) {
    figure.validate();
}

}  // namespace dynlab::inline documents
