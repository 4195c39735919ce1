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

constexpr std::array kMarkPlaceOptions = {OptionEntry{"x", ValueKind::kNumber, about("position on the x-axis")},
                                          OptionEntry{"y", ValueKind::kNumber, about("position on the y-axis")}};
constexpr std::array kReferenceOptions = {
    OptionEntry{"label", ValueKind::kText, about("text next to the line")},
    option<&ReferenceLine::dash>(
        "dash", about("dash pattern: 0 solid, 1 dashed, 2 dotted, 3 dash-dot, 4 to 7 further patterns"))};
constexpr std::array kAnnotationOptions = {
    OptionEntry{"text", ValueKind::kText, about("text next to the point")},
    option<&Annotation::marker>("marker", about("true draws a marker at the point"))};
constexpr std::array kArrowOptions = {
    OptionEntry{"x0", ValueKind::kNumber, about("x at the beginning of the arrow")},
    OptionEntry{"y0", ValueKind::kNumber, about("y at the beginning of the arrow")},
    OptionEntry{"x1", ValueKind::kNumber, about("x at the end of the arrow")},
    OptionEntry{"y1", ValueKind::kNumber, about("y at the end of the arrow")},
    OptionEntry{"text", ValueKind::kText, about("text at the middle of the arrow")},
    option<&Arrow::both_heads>("both_heads", about("true draws an arrowhead at both ends"))};
constexpr std::array kOneCurveOptions = {
    OptionEntry{"x", ValueKind::kVector, about("values on the x-axis; by default 1, 2, 3, ...")},
    OptionEntry{"y", ValueKind::kVector, about("values on the y-axis")},
    OptionEntry{"y_upper", ValueKind::kVector, about("upper limit of a band that starts at y")}};
constexpr OptionTable kPanelTables[] = {kPanelOptions}, kReferenceTables[] = {kMarkPlaceOptions, kReferenceOptions},
                      kAnnotationTables[] = {kMarkPlaceOptions, kAnnotationOptions}, kArrowTables[] = {kArrowOptions},
                      kOneCurveTables[] = {kOneCurveOptions, kCurveAppearanceOptions};

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
    const Options options(call, index, kReferenceTables);
    if (options.has("x") == options.has("y"))
        throw InvalidArgument("a reference line must be either {y = value} (horizontal) or {x = value} (vertical)");
    ReferenceLine line;
    line.horizontal = options.has("y");
    line.at = line.horizontal ? options.number("y", 0) : options.number("x", 0);
    line.label = label_option(options, "label");
    options.read(line);
    return line;
}

Annotation read_annotation(const Call& call, int index) {
    const Options options(call, index, kAnnotationTables);
    return {needed_number(options, "x", Message("an annotation")),
            needed_number(options, "y", Message("an annotation")), Message::verbatim(options.text("text", "")),
            options.flag("marker", true)};
}

Arrow read_arrow(const Call& call, int index) {
    const Options options(call, index, kArrowTables);
    return {needed_number(options, "x0", Message("an arrow")), needed_number(options, "y0", Message("an arrow")),
            needed_number(options, "x1", Message("an arrow")), needed_number(options, "y1", Message("an arrow")),
            Message::verbatim(options.text("text", "")),       options.flag("both_heads", false)};
}

/// In the order of the palette of figures/style; "grey" is "gray".
constexpr std::array kColorNames = {"blue", "orange", "black",   "green", "purple",
                                    "cyan", "red",    "magenta", "gray",  "grey"};
constexpr std::ptrdiff_t kGrey = 8;

int color_at(const Call& call, int index) {
    lua_State* L = call.state();
    if (lua_type(L, index) == LUA_TSTRING) {
        const std::string name = lua_tostring(L, index);
        const auto found = std::ranges::find(kColorNames, name);
        if (found != kColorNames.end()) return static_cast<int>(std::min(found - kColorNames.begin(), kGrey));
        throw InvalidArgument("{} must be {}, but \"{}\" was given", option_label("color"),
                              Message("an integer from 0 to 1000, or one of {}",
                                      listed_in_quotes({kColorNames.begin(), kColorNames.end()})),
                              name);
    }
    const double number = lua_type(L, index) == LUA_TNUMBER ? lua_tonumber(L, index) : -1;
    if (number < 0 || number != std::floor(number) || number > 1000)
        refuse_option("color", Message("an integer from 0 to 1000, or a name such as \"red\""), given_value(L, index));
    return static_cast<int>(number);
}

std::optional<int> optional_index(const Options& options, const char* name) {
    if (!options.has(name)) return std::nullopt;
    return static_cast<int>(options.size(name, 0));
}

/// A curve from its table; x defaults to 1, 2, 3, ...
Curve read_curve(const Call& call, int index) {
    const Options options(call, index, kOneCurveTables);
    Curve curve;
    curve.y = options.vector("y");
    curve.x = options.has("x") ? Vector(options.vector("x"))
                               : Vector::LinSpaced(curve.y.size(), 1, static_cast<double>(curve.y.size()));
    if (options.has("y_upper")) {
        curve.y_upper = options.vector("y_upper");
        curve.style = CurveStyle::kBand;
    }
    curve.label = label_option(options, "label");
    read_curve_appearance(options, curve);
    return curve;
}

}  // namespace

Message label_option(const Options& options, const char* name) {
    return Message::verbatim(with_marked_indices(options.text(name, "")));
}

CurveStyle parse_curve_style(const std::string& name) {
    const auto found = std::find(kCurveStyles.begin(), kCurveStyles.end(), name);
    if (found == kCurveStyles.end())
        throw InvalidArgument("{} must be one of {}, but \"{}\" was given", option_label("style"),
                              listed_in_quotes({kCurveStyles.begin(), kCurveStyles.end()}), name);
    return static_cast<CurveStyle>(found - kCurveStyles.begin());
}

std::vector<int> colors_of(const Options& options) {
    if (!options.has("color")) return {};
    lua_State* L = options.call().state();
    const int given = options.push("color");
    std::vector<int> colors;
    if (const NumericBlock* v = to_vector(L, given)) {
        for (Index i = 0; i < v->rows; ++i) {
            lua_pushnumber(L, to_vector(L, given)->data()[i]);
            colors.push_back(color_at(options.call(), -1));
            lua_pop(L, 1);
        }
    } else if (lua_type(L, given) == LUA_TTABLE) {
        for (lua_Integer i = 1; lua_rawgeti(L, given, i) != LUA_TNIL; ++i, lua_pop(L, 1))
            colors.push_back(color_at(options.call(), -1));
    } else {
        colors.push_back(color_at(options.call(), given));
    }
    lua_settop(L, given - 1);
    return colors;
}

void read_curve_appearance(const Options& options, Curve& curve) {
    options.read(curve);
    if (const std::vector<int> colors = colors_of(options); !colors.empty()) curve.color = colors.front();
    curve.dash = optional_index(options, "dash");
    curve.marker = optional_index(options, "marker");
}

void read_panel_options(const Call& call, const Options& options, Panel& panel) {
    const bool counted = !panel.title.empty() && panel.title == outside_text(panel);
    if (options.has("title")) panel.title = label_option(options, "title");
    if (options.has("xlabel")) panel.x_label = label_option(options, "xlabel");
    if (options.has("ylabel")) panel.y_label = label_option(options, "ylabel");
    if (options.has("x_range")) panel.x_range = options.range("x_range");
    if (options.has("y_range")) panel.y_range = options.range("y_range");
    if (counted && !options.has("title")) panel.title = outside_text(panel);
    options.read(panel);
    for_each_entry(call, options, "curves", [&](int entry) { panel.curves.push_back(read_curve(call, entry)); });
    for_each_entry(call, options, "references",
                   [&](int entry) { panel.references.push_back(read_reference(call, entry)); });
    for_each_entry(call, options, "annotations",
                   [&](int entry) { panel.annotations.push_back(read_annotation(call, entry)); });
    for_each_entry(call, options, "arrows", [&](int entry) { panel.arrows.push_back(read_arrow(call, entry)); });
}

Panel read_panel(const Call& call, int index) {
    Panel panel;
    read_panel_options(call, Options(call, index, kPanelTables), panel);
    return panel;
}

}  // namespace dynlab::inline scripting
