#pragma once
#include "data_io/values/array_descriptions.h"
#include "data_io/values/message_values.h"
#include "figures/figure.h"

namespace dynlab::inline documents {

/// Figures as data_io/values/described.h stores them, their texts as messages.

constexpr std::array<const char*, 7> names_of(CurveStyle) {
    return {"line", "points", "line_points", "stairs", "stems", "bars", "band"};
}

constexpr std::array<const char*, 5> names_of(LegendPlace) {
    return {"automatic", "above", "right", "none", "direct"};
}

DYNLAB_DESCRIBE(Curve, x, y, y_upper, style, label, color, dash, line_width, marker)
DYNLAB_DESCRIBE(ReferenceLine, horizontal, at, label, dash)
DYNLAB_DESCRIBE(SliderScale, slider, horizontal, value, values, places)

template <Is<Annotation> T, class V>
void describe(T& object, V& member) {
    auto& [x, y, text, marker, scales] = object;
    member("x", x), member("y", y), member("text", text), member("marker", marker);
    member.unless_empty("scales", scales);
}

DYNLAB_DESCRIBE(Arrow, x0, y0, x1, y1, text, both_heads)
DYNLAB_DESCRIBE(Panel, title, x_label, y_label, log_x, log_y, x_range, y_range, x_tick_step, y_tick_step, equal_axes,
                legend, curves, references, annotations, arrows)
DYNLAB_DESCRIBE(PlantPart, signal, unit, on, turns, x, y, by, drawn_at)
DYNLAB_DESCRIBE(PlantShape, x, y, part, filled, look)
DYNLAB_DESCRIBE(PlantDrawing, width, height, parts, pieces)
DYNLAB_DESCRIBE(Motion, plant, picture, measured, simulated)
DYNLAB_DESCRIBE(Figure, rows, columns, panels, title, width_cm, height_cm, motion)

inline void check_value(const Figure& figure, const ValueLimits&) {
    figure.validate();
}

}  // namespace dynlab::inline documents
