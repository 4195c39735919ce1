#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/message.h"
#include "figures/moving_plant.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline figures {

/// A picture as plain data: rows x columns of panels, each with curves and marks. Nothing here knows how it
/// is drawn. Its texts are messages, those of an author verbatim; readable_figure.h makes text of them.

/// Text of an axis: "time (s)", or the quantity alone where the unit is empty.
inline Message axis_label(const Message& quantity, const std::string& unit) {
    return unit.empty() ? quantity : Message("{} ({})", quantity, unit);
}

enum class CurveStyle { kLine, kPoints, kLinePoints, kStairs, kStems, kBars, kBand };

struct Curve {
    Vector x, y;
    Vector y_upper;  ///< kBand only: the band lies between y and y_upper
    CurveStyle style = CurveStyle::kLine;
    Message label;              ///< legend entry; none when empty
    std::optional<int> color;   ///< index into the house palette, 0-based; default: the curve's own index
    std::optional<int> dash;    ///< 0 solid, 1 dashed, 2 dotted, 3 dash-dot; default: chosen with the color
    double line_width = 0.9;    ///< points
    std::optional<int> marker;  ///< point shape, 0-based; default: chosen with the color
};

/// A straight reference: a level (horizontal) or an instant (vertical), over the whole panel.
struct ReferenceLine {
    bool horizontal = true;
    double at = 0;
    Message label;  ///< written beside the line when not empty
    int dash = 1;
};

/// How one coordinate of a mark goes with a slider of the script: a page turns the place to which the mark is dragged
/// into the slider's number.
struct SliderScale {
    std::string slider;
    bool horizontal = true;  ///< the abscissa; else the ordinate
    double value = 0;        ///< of the slider now
    Vector values, places;   ///< numbers of the slider, rising, and the coordinate at each: rising or falling
};

/// A marked reading point with its text, placed so that it stays inside the panel.
struct Annotation {
    double x = 0, y = 0;
    Message text;
    bool marker = true;
    std::vector<SliderScale> scales = {};  ///< at most one a coordinate; on a page the mark is a handle then
};

struct Arrow {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    Message text;  ///< at its middle
    bool both_heads = false;
};

/// Outside the curves, always; kDirect: each name beside its curve where all find a place that is clear, else
/// automatic.
enum class LegendPlace { kAutomatic, kAbove, kRight, kNone, kDirect };

struct Panel {
    Message title, x_label, y_label;
    bool log_x = false, log_y = false;
    std::optional<std::pair<double, double>> x_range, y_range;
    std::optional<double>
        x_tick_step;  ///< distance of the numbers on x, e.g. 1 for orders; default: chosen automatically
    std::optional<double> y_tick_step;  ///< the same on y, e.g. 45 for degrees
    bool equal_axes = false;            ///< one unit the same length on both axes (pole-zero maps, Nyquist)
    LegendPlace legend = LegendPlace::kAutomatic;
    std::vector<Curve> curves;
    std::vector<ReferenceLine> references;
    std::vector<Annotation> annotations;
    std::vector<Arrow> arrows;
};

struct Figure {
    int rows = 1, columns = 1;
    std::vector<Panel> panels;            ///< row by row, at most rows * columns
    Message title;                        ///< above all panels; documents use captions instead
    double width_cm = 14, height_cm = 0;  ///< height 0: chosen from the rows
    std::optional<Motion> motion;         ///< what pages show moving above it

    Figure() = default;
    explicit Figure(Panel panel) : panels{std::move(panel)} {}
    /// Throws InvalidArgument for curves whose x and y differ in length, no finite sample, too many panels,
    /// a range that is empty or not positive on a logarithmic axis, or a motion whose panels
    /// lack curves; names panel and curve.
    void validate() const;
};

}  // namespace dynlab::inline figures
