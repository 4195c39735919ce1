#include "documents/html/plot_data.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "documents/figure_description.h"
#include "documents/text_lines.h"
#include "figures/curve_traces.h"
#include "figures/label_placement.h"
#include "figures/readable_figure.h"
#include "figures/style.h"
#include "platform/utf8.h"

namespace dynlab::inline documents {
namespace {

using nlohmann::json;

constexpr Index kMaxSamples = 4000;
constexpr double kColumns = 1000;

/// A text in one piece as it is; else its pieces, each behind a sign: "=" on the line, "_" lowered, "^" raised.
json pieces_of(const std::string& text) {
    const std::vector<TextPiece> pieces = text_pieces(text);
    json list = json::array();
    for (const TextPiece& piece : pieces) {
        const char* const sign = piece.level == TextPiece::Level::kLine      ? "="
                                 : piece.level == TextPiece::Level::kLowered ? "_"
                                                                             : "^";
        list.push_back(sign + utf8_of(piece.text));
    }
    const bool plain = list.size() == 1 && pieces.front().level == TextPiece::Level::kLine;
    return plain ? json(utf8_of(pieces.front().text)) : list;
}

json pieces_of(const Message& label) {
    return pieces_of(message_text(label));
}

double value_at(const Axis& axis, double position) {
    if (!axis.log) return axis.low + position * (axis.high - axis.low);
    return std::exp(std::log(axis.low) + position * (std::log(axis.high) - std::log(axis.low)));
}

/// The value to 1e-5 of the axis' length, or, where that is logarithmic, of itself.
double rounded(double value, const Axis& axis) {
    const double size = axis.log ? std::abs(value) : axis.high - axis.low;
    if (!std::isfinite(value) || !(size > 1e-280 && size < 1e280)) return value;
    const int digits = 5 - static_cast<int>(std::floor(std::log10(size)));
    const double unit = std::pow(10.0, std::abs(digits));
    return digits >= 0 ? std::round(value * unit) / unit : std::round(value / unit) * unit;
}

json rounded_values(const Vector& values, const Axis& axis) {
    json list = json::array();
    for (const double value : values) list.push_back(rounded(value, axis));
    return list;
}

/// Equally spaced values by their first, their distance and their number.
json abscissas(const Vector& x, const Axis& axis) {
    const Index last = x.size() - 1;
    const double step = last > 1 ? (x[last] - x[0]) / static_cast<double>(last) : 0;
    bool even = std::isfinite(step) && step > 0;
    for (Index i = 0; i <= last && even; ++i)
        even = std::abs(x[i] - (x[0] + static_cast<double>(i) * step)) < 1e-6 * step;
    if (even) return {{"from", x[0]}, {"step", step}, {"count", x.size()}};
    return rounded_values(x, axis);
}

/// What a curve of very many samples shows.
Curve thinned(const Curve& curve, const PanelLayout& layout) {
    if (curve.x.size() <= kMaxSamples) return curve;
    const double width = layout.box.width(), height = layout.box.height(), cell = width / kColumns;
    const bool band = curve.style == CurveStyle::kBand;
    Trace lower, upper;
    for (Index i = 0; i < curve.x.size(); ++i) {
        const double place = layout.x.position(curve.x[i]);
        if (!(place >= -0.5 && place <= 1.5)) continue;
        lower.push_back({place * width, layout.y.position(curve.y[i]) * height});
        if (band) upper.push_back({place * width, layout.y.position(curve.y_upper[i]) * height});
    }
    if (band)
        std::tie(lower, upper) = decimate_band(lower, upper, cell);
    else
        lower = curve.style == CurveStyle::kPoints ? decimate_points(lower, cell) : decimate_line(lower, cell);
    Curve kept = curve;
    const auto size = static_cast<Index>(lower.size());
    kept.x.resize(size), kept.y.resize(size), kept.y_upper.resize(band ? size : 0);
    for (Index i = 0; i < size; ++i) {
        const auto k = static_cast<std::size_t>(i);
        kept.x[i] = value_at(layout.x, lower[k].x / width);
        kept.y[i] = value_at(layout.y, lower[k].y / height);
        if (band) kept.y_upper[i] = value_at(layout.y, upper[k].y / height);
    }
    return kept;
}

/// The lengths of "(9,4)", in widths of the line; none for a solid one.
json dash_lengths(const std::string& pattern) {
    return pattern == "solid" ? json::array() : json::parse(replaced(replaced(pattern, "(", "["), ")", "]"));
}

/// Writes one figure. Quantities without another unit are in cm on the page.
class PlotWriter {
  public:
    PlotWriter(const Figure& figure, bool decimal_comma)
        : figure_(figure), comma_(decimal_comma), page_(lay_out(figure)) {}

    json write() {
        json panels = json::array();
        add_block(page_.title, false);
        for (std::size_t i = 0; i < figure_.panels.size(); ++i)
            panels.push_back(panel_of(figure_.panels[i], page_.panels[i]));
        json data = {{"size", {page_.width, page_.height}}, {"comma", comma_}, {"texts", texts_}, {"panels", panels}};
        if (figure_.motion) data["motion"] = motion_of(*figure_.motion);
        return data;
    }

  private:
    void add_block(const CenteredText& block, bool upright) {
        const double step = style::kTextLine * block.text.size / style::kTextSize;
        const double count = static_cast<double>(block.text.lines.size());
        for (std::size_t i = 0; i < block.text.lines.size(); ++i) {
            const double shift = step * (0.5 * (count - 1) - static_cast<double>(i));
            texts_.push_back({{"text", pieces_of(block.text.lines[i])},
                              {"size", block.text.size},
                              {"x", block.x - (upright ? shift : 0)},
                              {"y", block.y + (upright ? 0 : shift)},
                              {"upright", upright}});
        }
    }

    json axis_of(const Axis& axis, const Message& label, bool numbers, double power_height) const {
        json ticks = json::array();
        for (const Tick& tick : axis.ticks)
            ticks.push_back({tick.value, pieces_of(comma_ ? with_decimal_commas(tick.label) : tick.label)});
        return {{"low", axis.low},          {"high", axis.high},  {"log", axis.log},           {"ticks", ticks},
                {"minor", axis.minor},      {"numbers", numbers}, {"exponent", axis.exponent}, {"power", power_height},
                {"label", pieces_of(label)}};
    }

    static json curve_of(const Curve& whole, int index, const PanelLayout& layout) {
        const Curve curve = thinned(whole, layout);
        const style::CurveAppearance look = style::appearance_of(curve, index);
        json data = {{"style", names_of(CurveStyle{})[static_cast<std::size_t>(curve.style)]},
                     {"name", pieces_of(curve.label)},
                     {"color", look.color},
                     {"dash", dash_lengths(look.dash)},
                     {"width", curve.line_width},
                     {"point", look.point_type},
                     {"size", style::marker_size(curve)},
                     {"edge", style::marker_line(curve)},
                     {"x", abscissas(curve.x, layout.x)},
                     {"y", rounded_values(curve.y, layout.y)}};
        if (curve.x.size() != whole.x.size()) data["samples"] = whole.x.size();
        if (curve.style == CurveStyle::kBand) data["upper"] = rounded_values(curve.y_upper, layout.y);
        return data;
    }

    /// The samples of curves over the same abscissas name the first that has them.
    static json curves_of(const Panel& panel, const PanelLayout& layout) {
        json curves = json::array();
        for (std::size_t i = 0; i < panel.curves.size(); ++i) {
            json curve = curve_of(panel.curves[i], static_cast<int>(i), layout);
            for (std::size_t k = 0; k < i && !curve["x"].is_number(); ++k)
                if (curves[k]["x"] == curve["x"]) curve["x"] = k;
            curves.push_back(std::move(curve));
        }
        return curves;
    }

    static json legend_of(const PanelLayout& layout) {
        json entries = json::array();
        for (const LegendEntry& entry : layout.legend)
            entries.push_back({{"curve", entry.curve},
                               {"x", entry.x},
                               {"y", entry.y},
                               {"width", style::kLegendSample + style::kGap + text_width(entry.text, entry.size)},
                               {"size", entry.size},
                               {"text", pieces_of(entry.text)}});
        return entries;
    }

    /// Texts within the frame by the values at their middle, so that they move with what they name.
    static json labels_of(const Panel& panel, const PanelLayout& layout) {
        std::vector<CurveTraces> traces;
        for (const Curve& curve : panel.curves) traces.push_back(traces_of(curve, layout));
        const auto value = [&](double x, double y) {
            return json{value_at(layout.x, x / layout.box.width()), value_at(layout.y, y / layout.box.height())};
        };
        json labels = json::array();
        for (const PlacedLabel& label : place_labels(panel, layout, traces)) {
            labels.push_back({{"text", pieces_of(label.text)}, {"at", value(label.x, label.y)}});
            if (label.leader_from)
                labels.back()["leader"] = {value(label.leader_from->x, label.leader_from->y),
                                           value(label.leader_to->x, label.leader_to->y)};
        }
        return labels;
    }

    static json motion_of(const Motion& motion) {
        json parts = json::array(), pieces = json::array();
        for (const PlantPart& part : motion.plant.parts)
            parts.push_back({{"on", part.on},
                             {"turns", part.turns},
                             {"x", part.x},
                             {"y", part.y},
                             {"by", part.by},
                             {"at", part.drawn_at}});
        const auto rounded_length = [](double length) { return std::round(1e3 * length) / 1e3; };
        for (const PlantShape& piece : motion.plant.pieces) {
            json points = json::array();
            for (std::size_t i = 0; i < piece.x.size(); ++i)
                points.push_back({rounded_length(piece.x[i]), rounded_length(piece.y[i]), piece.part[i]});
            pieces.push_back({{"points", points}, {piece.filled ? "shade" : "width", piece.look}});
        }
        return {{"size", {motion.plant.width, motion.plant.height}},
                {"parts", parts},
                {"pieces", pieces},
                {"picture", motion.picture},
                {"measured", motion.measured},
                {"simulated", motion.simulated}};
    }

    /// Marks that sliders move: where a slider's numbers put them, and the other way round.
    static json handles_of(const Panel& panel, const PanelLayout& layout) {
        json handles = json::array();
        for (const Annotation& mark : panel.annotations) {
            if (mark.scales.empty()) continue;
            json scales = json::array();
            for (const SliderScale& scale : mark.scales)
                scales.push_back({{"slider", scale.slider},
                                  {"horizontal", scale.horizontal},
                                  {"value", scale.value},
                                  {"values", std::vector<double>(scale.values.begin(), scale.values.end())},
                                  {"places", rounded_values(scale.places, scale.horizontal ? layout.x : layout.y)}});
            handles.push_back({{"x", mark.x}, {"y", mark.y}, {"name", pieces_of(mark.text)}, {"scales", scales}});
        }
        return handles;
    }

    json panel_of(const Panel& panel, const PanelLayout& layout) {
        add_block(layout.title, false);
        add_block(layout.x_label, false);
        add_block(layout.y_label, true);
        json lines = json::array(), marks = json::array(), arrows = json::array();
        for (const ReferenceLine& line : panel.references)
            lines.push_back({{"horizontal", line.horizontal},
                             {"at", line.at},
                             {"dash", dash_lengths(style::dash_pattern(line.dash))}});
        for (const Annotation& mark : panel.annotations)
            if (mark.marker) marks.push_back({mark.x, mark.y});
        for (const Arrow& arrow : panel.arrows)
            arrows.push_back(
                {{"from", {arrow.x0, arrow.y0}}, {"to", {arrow.x1, arrow.y1}}, {"both", arrow.both_heads}});
        const Rectangle& box = layout.box;
        return {{"box", {box.left, box.bottom, box.right, box.top}},
                {"x", axis_of(layout.x, panel.x_label, layout.x_numbers, layout.exponent_x)},
                {"y", axis_of(layout.y, panel.y_label, true, layout.exponent_y)},
                {"equal", panel.equal_axes},
                {"curves", curves_of(panel, layout)},
                {"lines", lines},
                {"marks", marks},
                {"handles", handles_of(panel, layout)},
                {"arrows", arrows},
                {"labels", labels_of(panel, layout)},
                {"legend", legend_of(layout)}};
    }

    const Figure& figure_;
    const bool comma_;
    const FigureLayout page_;
    json texts_ = json::array();
};

}  // namespace

std::string plot_data(const Figure& figure, const Reader& reader) {
    figure.validate();
    const Figure shown = readable(figure, reader);
    const std::string text = PlotWriter(shown, has_decimal_comma(reader)).write().dump(-1, ' ', true);
    return replaced(text, "<", "\\u003c");
}

}  // namespace dynlab::inline documents
