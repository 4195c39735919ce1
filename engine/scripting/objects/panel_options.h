#pragma once
#include <initializer_list>

#include "figures/figure.h"
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// Options that describe a panel (axes and marks), a curve and a whole figure; the names scripts use.
inline constexpr std::initializer_list<const char*> kCurveOptions = {"x",      "y",    "y_upper",    "label", "style",
                                                                     "colour", "dash", "line_width", "marker"};
inline constexpr std::initializer_list<const char*> kPanelOptions = {
    "title",      "xlabel", "ylabel", "x_range",    "y_range",     "x_log", "y_log",
    "equal_axes", "legend", "curves", "references", "annotations", "arrows"};

/// Sets of `panel` what the options name.
void read_panel_options(const Call& call, const Options& options, Panel& panel);
/// Places in the palette by number or name: one for all curves, or one each; empty when the option is not given.
std::vector<int> colours_of(const Options& options);
/// Sets style, colour, dash, width and marker of `curve`.
void read_curve_look(const Options& options, Curve& curve);
/// What an author wrote, with its indices marked; empty where the option is not given.
Message label_option(const Options& options, const char* name);
CurveStyle parse_curve_style(const std::string& name);
/// A panel from its table.
Panel read_panel(const Call& call, int index);

}  // namespace dynlab::inline scripting
