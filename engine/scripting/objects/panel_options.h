#pragma once
#include <array>

#include "figures/figure.h"
#include "scripting/conversions/option_member.h"

namespace dynlab::inline scripting {

inline constexpr std::array kCurveStyles = {"line", "points", "line_points", "stairs", "stems", "bars", "band"};
inline constexpr std::array kLegendPlaces = {"automatic", "above", "right", "none", "direct"};

/// The options of a panel, of one curve's look and of a whole figure, for plot, figure and the methods of figures.
inline constexpr std::array kPanelOptions = {
    OptionEntry{"title", ValueKind::kText, about("text above the panel, or above all panels of a figure")},
    OptionEntry{"xlabel", ValueKind::kText, about("x-axis label")},
    OptionEntry{"ylabel", ValueKind::kText, about("y-axis label")},
    OptionEntry{"x_range", ValueKind::kVector, about("x-axis limits, {low, high}")},
    OptionEntry{"y_range", ValueKind::kVector, about("y-axis limits, {low, high}")},
    option<&Panel::log_x>("x_log", about("true for a logarithmic x-axis")),
    option<&Panel::log_y>("y_log", about("true for a logarithmic y-axis")),
    option<&Panel::equal_axes>("equal_axes", about("true for equal data units on both axes")),
    option<&Panel::legend>("legend",
                           about("position of the legend; \"direct\" writes each name next to its curve, or creates a "
                                 "legend if there is not enough space"),
                           {.initial = "\"automatic\"", .choices = kLegendPlaces}),
    OptionEntry{"curves", ValueKind::kTable,
                about("list of curves, each {x =, y =, label =, style =, color =, dash =, line_width =, marker =}; a "
                      "curve with y_upper is a band from y to y_upper")},
    OptionEntry{"references", ValueKind::kTable,
                about("list of reference lines: horizontal {y = value, label =, dash =} or vertical {x = value, label "
                      "=, dash =}")},
    OptionEntry{"annotations", ValueKind::kTable, about("list of marked points, {x =, y =, text =, marker =}")},
    OptionEntry{"arrows", ValueKind::kTable, about("list of arrows, {x0 =, y0 =, x1 =, y1 =, text =, both_heads =}")}};

inline constexpr std::array kCurveAppearanceOptions = {
    OptionEntry{"label", ValueKind::kText, about("name of the curve in the legend")},
    option<&Curve::style>("style", about("style of the curve"), {.initial = "\"line\"", .choices = kCurveStyles}),
    OptionEntry{"color", ValueKind::kAny, about("number in the palette, starting at 0, or a name such as \"red\"")},
    OptionEntry{"dash", ValueKind::kCount,
                about("dash pattern: 0 solid, 1 dashed, 2 dotted, 3 dash-dot, 4 to 7 further patterns")},
    OptionEntry{"marker", ValueKind::kCount,
                about("marker: 0 dot, 1 square, 2 triangle, 3 diamond, 4 to 7 the same shapes unfilled, 8 cross, 9 "
                      "plus, 10 asterisk")},
    option<&Curve::line_width>("line_width", about("line width"), {.unit = "points"})};

inline constexpr std::array kFigureSizeOptions = {
    option<&Figure::width_cm>("width", about("width of the figure"), {.unit = "cm"}),
    option<&Figure::height_cm>("height", about("height of the figure; 0 for a height that fits the panels"),
                               {.unit = "cm"})};

/// Sets of `panel` what the options name.
void read_panel_options(const Call& call, const Options& options, Panel& panel);
/// Places in the palette by number or name: one for all curves, or one each; empty when the option is not given.
std::vector<int> colors_of(const Options& options);
/// Sets style, color, dash, width and marker of `curve`.
void read_curve_appearance(const Options& options, Curve& curve);
/// What an author wrote, with its indices marked; empty where the option is not given.
Message label_option(const Options& options, const char* name);
CurveStyle parse_curve_style(const std::string& name);
/// A panel from its table.
Panel read_panel(const Call& call, int index);

}  // namespace dynlab::inline scripting
