#include "figures/gnuplot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "figures/label_placement.h"
#include "figures/readable_figure.h"
#include "figures/style.h"

namespace dynlab::inline figures {
namespace {

using namespace style;

/// Writes one panel. Coordinates are cm from the frame's lower left corner, gnuplot's "first" system here.
class PanelScript {
  public:
    PanelScript(const Panel& panel, const PanelLayout& layout, const FigureLayout& page, bool decimal_comma,
                std::string& out)
        : panel_(panel), layout_(layout), page_(page), decimal_comma_(decimal_comma), out_(out) {}

    void write(bool with_page_title) {
        write_frame();
        if (with_page_title) write_page_title();
        write_numbers();
        write_texts();
        for (const Curve& curve : panel_.curves) traces_.push_back(traces_of(curve, layout_));
        write_references();
        write_arrows();
        write_marks();
        for (const PlacedLabel& label : place_labels(panel_, layout_, traces_)) write_label(label);
        for (const LegendEntry& entry : layout_.legend) write_legend_entry(entry);
        write_curves();
    }

  private:
    template <class... Args>
    void put(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    }
    double width() const { return layout_.box.width(); }
    double height() const { return layout_.box.height(); }

    void write_frame() {
        const Rectangle& box = layout_.box;
        put("unset label; unset arrow; unset object\n");
        put("set lmargin at screen {:.6f}; set rmargin at screen {:.6f}\n", box.left / page_.width,
            box.right / page_.width);
        put("set bmargin at screen {:.6f}; set tmargin at screen {:.6f}\n", box.bottom / page_.height,
            box.top / page_.height);
        put("set xrange [0:{:.4f}]; set yrange [0:{:.4f}]\n", width(), height());
        put("set border 15 lw {} lc rgb '{}'\n", kFrameWidth, kFrameColor);
        write_ticks('x', layout_.x, width());
        write_ticks('y', layout_.y, height());
        put("set grid xtics mxtics ytics mytics back lt 1 lw {} lc rgb '{}', lt 1 lw {} lc rgb '#eeeeee'\n", kGridWidth,
            kGridColor, 0.75 * kGridWidth);
    }

    void write_ticks(char name, const Axis& axis, double length) {
        if (axis.ticks.empty() && axis.minor.empty()) return put("unset {}tics\n", name);  // an empty list: its own
        put("set {}tics out nomirror scale 0.45,0.25 (", name);
        const char* separator = "";
        const auto tick = [&](double value, int level) {
            put("{}'' {:.4f} {}", separator, axis.position(value) * length, level);
            separator = ", ";
        };
        for (const Tick& major : axis.ticks) tick(major.value, 0);
        for (const double minor : axis.minor) tick(minor, 1);
        put(")\n");
    }

    void text(const std::string& content, double x, double y, const char* align, double size, const char* color,
              bool upright = false) {
        put("set label {} at {:.4f},{:.4f} {} {} font ',{:.2f}' tc rgb '{}' front\n", gnuplot_text(content), x, y,
            align, upright ? "rotate by 90" : "norotate", size, color);
    }

    std::string number(const Tick& tick) const { return decimal_comma_ ? with_decimal_commas(tick.label) : tick.label; }

    void write_numbers() {
        const double below = -kTickLength - 0.5 * kTickLine, left = -kTickLength - 0.08;
        if (layout_.x_numbers)
            for (const Tick& tick : layout_.x.ticks)
                text(number(tick), layout_.x.position(tick.value) * width(), below, "center", kTickSize, kFrameColor);
        for (const Tick& tick : layout_.y.ticks)
            text(number(tick), left, layout_.y.position(tick.value) * height(), "right", kTickSize, kFrameColor);
        const auto power = [](int exponent) {
            return fmt::format("×10^{{{}{}}}", exponent < 0 ? "−" : "", std::abs(exponent));
        };
        if (layout_.x_numbers && layout_.x.exponent != 0)
            text(power(layout_.x.exponent), width(), layout_.exponent_x - layout_.box.bottom, "right", kTickSize,
                 kFrameColor);
        if (layout_.y.exponent != 0)
            text(power(layout_.y.exponent), 0, layout_.exponent_y - layout_.box.bottom, "left", kTickSize, kFrameColor);
    }

    void block(const CenteredText& placed, bool upright = false) {
        const double count = static_cast<double>(placed.text.lines.size());
        for (std::size_t i = 0; i < placed.text.lines.size(); ++i) {
            const double step = kTextLine * placed.text.size / kTextSize;
            const double shift = step * (0.5 * (count - 1) - static_cast<double>(i));
            text(placed.text.lines[i], placed.x - layout_.box.left - (upright ? shift : 0),
                 placed.y - layout_.box.bottom + (upright ? 0 : shift), "center", placed.text.size, kAnnotationColor,
                 upright);
        }
    }
    void write_page_title() { block(page_.title); }
    void write_texts() {
        block(layout_.title);
        block(layout_.x_label);
        block(layout_.y_label, true);
    }

    void segment(PagePoint from, PagePoint to, const char* heads, double line_width, const std::string& color,
                 const std::string& dash, const char* layer) {
        put("set arrow from {:.4f},{:.4f} to {:.4f},{:.4f} {} lw {:.3f} lc rgb '{}' dt {} {}\n", from.x, from.y, to.x,
            to.y, heads, line_width, color, dash, layer);
    }

    void write_references() {
        for (const ReferenceLine& line : panel_.references) {
            const double position = (line.horizontal ? layout_.y : layout_.x).position(line.at);
            if (!(position >= 0 && position <= 1)) continue;
            const PagePoint from =
                line.horizontal ? PagePoint{0, position * height()} : PagePoint{position * width(), 0};
            const PagePoint to = line.horizontal ? PagePoint{width(), from.y} : PagePoint{from.x, height()};
            segment(from, to, "nohead", kReferenceWidth, kReferenceColor, dash_pattern(line.dash), "back");
        }
    }

    PagePoint inside(double x, double y) const {
        return {std::clamp(layout_.x.position(x), 0.0, 1.0) * width(),
                std::clamp(layout_.y.position(y), 0.0, 1.0) * height()};
    }

    void write_arrows() {
        for (const Arrow& arrow : panel_.arrows) {
            const PagePoint from = inside(arrow.x0, arrow.y0), to = inside(arrow.x1, arrow.y1);
            const double head = std::min(0.2, 0.4 * std::hypot(to.x - from.x, to.y - from.y));
            segment(from, to,
                    fmt::format("{} filled size first {:.3f},18", arrow.both_heads ? "heads" : "head", head).c_str(),
                    kArrowWidth, kAnnotationColor, "solid", "front");
        }
    }

    void marker(PagePoint at, int type, double size, double line_width, const std::string& color) {
        put("set label '' at {:.4f},{:.4f} point pt {} ps {:.2f} lw {:.2f} lc rgb '{}' front\n", at.x, at.y, type, size,
            line_width, color);
    }

    void write_marks() {
        for (const Annotation& mark : panel_.annotations) {
            const double x = layout_.x.position(mark.x), y = layout_.y.position(mark.y);
            if (mark.marker && x >= 0 && x <= 1 && y >= 0 && y <= 1)
                marker({x * width(), y * height()}, 7, 0.45, 0.5, kAnnotationColor);
        }
    }

    void write_label(const PlacedLabel& label) {
        if (label.leader_from)
            segment(*label.leader_from, *label.leader_to, "nohead", 0.3, kReferenceColor, "solid", "front");
        text(label.text, label.x, label.y, "center", kTextSize, kAnnotationColor);
    }

    static bool draws_line(CurveStyle style) { return style != CurveStyle::kPoints && style != CurveStyle::kBars; }
    static bool draws_points(CurveStyle style) {
        return style == CurveStyle::kPoints || style == CurveStyle::kLinePoints || style == CurveStyle::kStems;
    }

    void write_legend_entry(const LegendEntry& entry) {
        const Curve& curve = panel_.curves[entry.curve];
        const CurveAppearance look = appearance_of(curve, static_cast<int>(entry.curve));
        const double x = entry.x - layout_.box.left, y = entry.y - layout_.box.bottom;
        if (curve.style == CurveStyle::kBand || curve.style == CurveStyle::kBars)
            put("set object rectangle from {:.4f},{:.4f} to {:.4f},{:.4f} front noclip fc rgb '{}' fs {} noborder\n", x,
                y - 0.11, x + kLegendSample, y + 0.11, look.color, fill(curve.style));
        else if (draws_line(curve.style))
            segment({x, y}, {x + kLegendSample, y}, "nohead", curve.line_width, look.color, look.dash, "front");
        if (draws_points(curve.style))
            marker({x + 0.5 * kLegendSample, y}, look.point_type, marker_size(curve), marker_line(curve), look.color);
        text(entry.text, x + kLegendSample + kGap, y, "left", entry.size, kAnnotationColor);
    }

    static const char* fill(CurveStyle style) {
        return style == CurveStyle::kBand ? "transparent solid 0.22" : "transparent solid 0.6";
    }

    /// Adds a data block and the plot element that draws it with `how`.
    template <class Lines>
    void element(const std::string& how, Lines lines) {
        const std::string name = fmt::format("$d{}", blocks_++);
        put("{} << EOD\n", name);
        lines();
        put("EOD\n");
        elements_ += (elements_.empty() ? "" : ", ") + name + " " + how;
    }
    void put_trace(const Trace& trace) {
        for (const PagePoint& point : trace) {
            if (point.gap())
                put("\n");
            else
                put("{:.4f} {:.4f}\n", point.x, point.y);
        }
    }

    void write_curve(const Curve& curve, const CurveTraces& traces, const CurveAppearance& look) {
        if (!traces.lower.empty())
            element(fmt::format("u 1:2:3 w filledcurves lc rgb '{}' fs {} noborder", look.color, fill(curve.style)),
                    [&] {
                        for (std::size_t i = 0; i < traces.lower.size(); ++i)
                            if (traces.lower[i].gap())
                                put("\n");
                            else
                                put("{:.4f} {:.4f} {:.4f}\n", traces.lower[i].x, traces.lower[i].y, traces.upper[i].y);
                    });
        if (!traces.lower.empty() && several_bands())
            for (const Trace* edge : {&traces.lower, &traces.upper})
                element(fmt::format("u 1:2 w lines lw {:.3f} lc rgb '{}' dt {}", kBandEdgeWidth, look.color, look.dash),
                        [&] { put_trace(*edge); });
        if (!traces.bars.empty())
            element(fmt::format("u 1:2:3:4:5:6 w boxxyerror lw 0.3 lc rgb '{}' fs {} border lc rgb 'white'", look.color,
                                fill(curve.style)),
                    [&] {
                        for (const Rectangle& bar : traces.bars)
                            put("{0:.4f} {1:.4f} {0:.4f} {2:.4f} {1:.4f} {3:.4f}\n", bar.left, bar.bottom, bar.right,
                                bar.top);
                    });
        if (!traces.line.empty())
            element(fmt::format("u 1:2 w lines lw {:.3f} lc rgb '{}' dt {}",
                                curve.style == CurveStyle::kStems ? 0.8 * curve.line_width : curve.line_width,
                                look.color, look.dash),
                    [&] { put_trace(traces.line); });
        if (!traces.points.empty())
            element(fmt::format("u 1:2 w points pt {} ps {:.2f} lw {:.2f} lc rgb '{}'",
                                draws_points(curve.style) ? look.point_type : 7,
                                draws_points(curve.style) ? marker_size(curve) : 0.25, marker_line(curve), look.color),
                    [&] { put_trace(traces.points); });
    }

    /// With several bands, their grays alone would not distinguish them.
    bool several_bands() const {
        const auto is_band = [](const Curve& curve) { return curve.style == CurveStyle::kBand; };
        return std::count_if(panel_.curves.begin(), panel_.curves.end(), is_band) > 1;
    }

    void write_curves() {
        // Bands lie under all lines, whatever their order.
        for (const bool bands : {true, false})
            for (std::size_t i = 0; i < traces_.size(); ++i)
                if ((panel_.curves[i].style == CurveStyle::kBand) == bands)
                    write_curve(panel_.curves[i], traces_[i], appearance_of(panel_.curves[i], static_cast<int>(i)));
        put("plot {}\n", elements_.empty() ? "-1e6" : elements_);  // a level far below the frame draws the frame alone
    }

    const Panel& panel_;
    const PanelLayout& layout_;
    const FigureLayout& page_;
    bool decimal_comma_;
    std::string& out_;
    std::vector<CurveTraces> traces_;
    std::string elements_;
    int blocks_ = 0;
};

std::string terminal(FigureFormat format, double width_cm, double height_cm) {
    const auto pixels = [](double cm, double per_inch) { return std::lround(cm / 2.54 * per_inch); };
    switch (format) {
        case FigureFormat::kPdf:  // its unit of type is 1/96 inch, its unit of lines half a point
            return fmt::format("pdfcairo enhanced color size {:.4f}cm,{:.4f}cm font '{},{}' fontscale 0.75 linewidth 2",
                               width_cm, height_cm, kTextFont, kTextSize);
        case FigureFormat::kSvg:  // 96 units to the inch, so that type keeps its size
            return fmt::format("svg enhanced size {},{} font '{},{}' fontscale {:.4f} linewidth {:.4f}",
                               pixels(width_cm, 96), pixels(height_cm, 96), kTextFont, kTextSize, 96.0 / 72, 96.0 / 72);
        case FigureFormat::kPng:  // twice the resolution of a screen
            return fmt::format(
                "pngcairo enhanced size {},{} font '{},{}' fontscale 2 linewidth 2.6667 pointscale 2.6667",
                pixels(width_cm, 192), pixels(height_cm, 192), kTextFont, kTextSize);
    }
    return {};
}

}  // namespace

std::string gnuplot_script(const Figure& figure, FigureFormat format, const Reader& reader) {
    const Figure shown = readable(figure, reader);
    const FigureLayout page = lay_out(shown);
    std::string out = "reset\nset encoding utf8\n";
    out += "set terminal " + terminal(format, page.width, page.height) + "\n";
    out += "set output output_file\n";
    out += "set multiplot\nunset key\nset clip two\n";
    for (std::size_t i = 0; i < shown.panels.size(); ++i)
        PanelScript(shown.panels[i], page.panels[i], page, has_decimal_comma(reader), out).write(i == 0);
    out += "unset multiplot\nset output\n";
    return out;
}

std::string gnuplot_file(const Figure& figure, FigureFormat format, const std::string& output, const Reader& reader) {
    return fmt::format(
        "# Draw the figure with: gnuplot FILE, where FILE is this file; it contains the data.\noutput_file = {}\n{}",
        gnuplot_quoted(output), gnuplot_script(figure, format, reader));
}

}  // namespace dynlab::inline figures
