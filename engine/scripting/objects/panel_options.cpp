#include "scripting/objects/panel_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "figures/figure_text.h"
#include "figures/plots/monte_carlo_plot.h"
#include "scripting/conversions/option_words.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kStyleNames = {"line", "points", "line_points", "stairs", "stems", "bars", "band"};

/// Calls `read` with the stack index of every entry of the list under `name`.
void for_each_entry(const Call& call, const Options& options, const char* name, const std::function<void(int)>& read) {
    lua_State* L = call.state();
    const int list = options.push(name);
    if (!lua_isnil(L, list) && lua_type(L, list) != LUA_TTABLE)
        refuse_option(name, Message("a list of tables"), given_value(L, list));
    if (!lua_isnil(L, list)) {
        for (lua_Integer i = 1; lua_rawgeti(L, list, i) != LUA_TNIL; ++i) {
            read(lua_gettop(L));
            lua_settop(L, list);
        }
    }
    lua_settop(L, list - 1);
}

double needed_number(const Options& options, const char* name, const Message& whose) {
    const auto value = options.optional_number(name);
    if (!value) throw InvalidArgument("{} needs {} = number", whose, name);
    return *value;
}

ReferenceLine read_reference(const Call& call, int index) {
    const Options options(call, index, {"x", "y", "label", "dash"});
    if (options.has("x") == options.has("y"))
        throw InvalidArgument("a reference is {y = level} or {x = instant}, one of both");
    ReferenceLine line;
    line.horizontal = options.has("y");
    line.at = line.horizontal ? options.number("y", 0) : options.number("x", 0);
    line.label = label_option(options, "label");
    line.dash = static_cast<int>(options.size("dash", line.dash));
    return line;
}

Annotation read_annotation(const Call& call, int index) {
    const Options options(call, index, {"x", "y", "text", "marker"});
    return {needed_number(options, "x", Message("an annotation")),
            needed_number(options, "y", Message("an annotation")), Message::verbatim(options.text("text", "")),
            options.flag("marker", true)};
}

Arrow read_arrow(const Call& call, int index) {
    const Options options(call, index, {"x0", "y0", "x1", "y1", "text", "both_heads"});
    return {needed_number(options, "x0", Message("an arrow")), needed_number(options, "y0", Message("an arrow")),
            needed_number(options, "x1", Message("an arrow")), needed_number(options, "y1", Message("an arrow")),
            Message::verbatim(options.text("text", "")),       options.flag("both_heads", false)};
}

struct ColourName {
    std::string_view name;
    int place;  ///< in the palette of figures/style
};

constexpr std::array kColourNames = {ColourName{"blue", 0},  ColourName{"orange", 1},  ColourName{"black", 2},
                                     ColourName{"green", 3}, ColourName{"purple", 4},  ColourName{"cyan", 5},
                                     ColourName{"red", 6},   ColourName{"magenta", 7}, ColourName{"grey", 8},
                                     ColourName{"gray", 8}};

int colour_at(const Call& call, int index) {
    lua_State* L = call.state();
    if (lua_type(L, index) == LUA_TSTRING) {
        const std::string name = lua_tostring(L, index);
        for (const ColourName& known : kColourNames)
            if (known.name == name) return known.place;
        std::vector<std::string> all;
        for (const ColourName& known : kColourNames) all.emplace_back(known.name);
        throw InvalidArgument("{} must be {}, but \"{}\" was given", option_label("colour"),
                              Message("a number from 0 on, or one of {}", listed_in_quotes(all)), name);
    }
    const double number = lua_type(L, index) == LUA_TNUMBER ? lua_tonumber(L, index) : -1;
    if (number < 0 || number != std::floor(number) || number > 1000)
        refuse_option("colour", Message("a whole number from 0 on, or a name such as \"red\""), given_value(L, index));
    return static_cast<int>(number);
}

std::optional<int> optional_index(const Options& options, const char* name) {
    if (!options.has(name)) return std::nullopt;
    return static_cast<int>(options.size(name, 0));
}

/// A curve from its table; x defaults to 1, 2, 3, ...
Curve read_curve(const Call& call, int index) {
    const Options options(call, index, kCurveOptions);
    Curve curve;
    curve.y = options.vector("y");
    curve.x = options.has("x") ? Vector(options.vector("x"))
                               : Vector::LinSpaced(curve.y.size(), 1, static_cast<double>(curve.y.size()));
    if (options.has("y_upper")) {
        curve.y_upper = options.vector("y_upper");
        curve.style = CurveStyle::kBand;
    }
    curve.label = label_option(options, "label");
    read_curve_look(options, curve);
    return curve;
}

}  // namespace

Message label_option(const Options& options, const char* name) {
    return Message::verbatim(with_marked_indices(options.text(name, "")));
}

CurveStyle parse_curve_style(const std::string& name) {
    const auto found = std::find(kStyleNames.begin(), kStyleNames.end(), name);
    if (found == kStyleNames.end())
        throw InvalidArgument("{} must be one of {}, but \"{}\" was given", option_label("style"),
                              listed_in_quotes({kStyleNames.begin(), kStyleNames.end()}), name);
    return static_cast<CurveStyle>(found - kStyleNames.begin());
}

std::vector<int> colours_of(const Options& options) {
    if (!options.has("colour")) return {};
    lua_State* L = options.call().state();
    const int given = options.push("colour");
    std::vector<int> colours;
    if (const NumericBlock* v = to_vector(L, given)) {
        for (Index i = 0; i < v->rows; ++i) {
            lua_pushnumber(L, to_vector(L, given)->data()[i]);
            colours.push_back(colour_at(options.call(), -1));
            lua_pop(L, 1);
        }
    } else if (lua_type(L, given) == LUA_TTABLE) {
        for (lua_Integer i = 1; lua_rawgeti(L, given, i) != LUA_TNIL; ++i, lua_pop(L, 1))
            colours.push_back(colour_at(options.call(), -1));
    } else {
        colours.push_back(colour_at(options.call(), given));
    }
    lua_settop(L, given - 1);
    return colours;
}

void read_curve_look(const Options& options, Curve& curve) {
    if (options.has("style")) curve.style = parse_curve_style(options.text("style", ""));
    if (const std::vector<int> colours = colours_of(options); !colours.empty()) curve.colour = colours.front();
    curve.dash = optional_index(options, "dash");
    curve.marker = optional_index(options, "marker");
    curve.line_width = options.number("line_width", curve.line_width);
}

void read_panel_options(const Call& call, const Options& options, Panel& panel) {
    const bool counted = !panel.title.empty() && panel.title == outside_text(panel);
    if (options.has("title")) panel.title = label_option(options, "title");
    if (options.has("xlabel")) panel.x_label = label_option(options, "xlabel");
    if (options.has("ylabel")) panel.y_label = label_option(options, "ylabel");
    if (options.has("x_range")) panel.x_range = options.range("x_range");
    if (options.has("y_range")) panel.y_range = options.range("y_range");
    if (counted && !options.has("title")) panel.title = outside_text(panel);
    panel.log_x = options.flag("x_log", panel.log_x);
    panel.log_y = options.flag("y_log", panel.log_y);
    panel.equal_axes = options.flag("equal_axes", panel.equal_axes);
    panel.legend = static_cast<LegendPlace>(options.choice("legend", {"automatic", "above", "right", "none", "direct"},
                                                           static_cast<std::size_t>(panel.legend)));
    for_each_entry(call, options, "curves", [&](int entry) { panel.curves.push_back(read_curve(call, entry)); });
    for_each_entry(call, options, "references",
                   [&](int entry) { panel.references.push_back(read_reference(call, entry)); });
    for_each_entry(call, options, "annotations",
                   [&](int entry) { panel.annotations.push_back(read_annotation(call, entry)); });
    for_each_entry(call, options, "arrows", [&](int entry) { panel.arrows.push_back(read_arrow(call, entry)); });
}

Panel read_panel(const Call& call, int index) {
    Panel panel;
    read_panel_options(call, Options(call, index, kPanelOptions), panel);
    return panel;
}

}  // namespace dynlab::inline scripting
