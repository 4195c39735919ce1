#include <array>
#include <cmath>

#include "base/number_text.h"
#include "figures/style.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/panel_options.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kPanelNumberOptions = {
    OptionEntry{"panel", ValueKind::kCount, about("number of the panel"), {.initial = "1"}}};
constexpr std::array kHandleOptions = {
    OptionEntry{"x", ValueKind::kAny, about("position on the x-axis: a number, or a function of the slider value")},
    OptionEntry{"x_slider", ValueKind::kText, about("name of the slider that moves x")},
    OptionEntry{"y", ValueKind::kAny, about("position on the y-axis: a number, or a function of the slider value")},
    OptionEntry{"y_slider", ValueKind::kText, about("name of the slider that moves y")},
    OptionEntry{"text", ValueKind::kText, about("text next to the point")}};
constexpr OptionTable kAddTables[] = {kCurveAppearanceOptions, kPanelNumberOptions},
                      kHandleTables[] = {kHandleOptions, kPanelNumberOptions},
                      kSetTables[] = {kPanelOptions, kFigureSizeOptions, kPanelNumberOptions};

Figure& figure_self(Call& call) {
    return object_argument<FigurePointer>(call, 1, "figure")->figure;
}

Panel& panel_of(Figure& figure, Index number) {
    if (number < 1 || number > static_cast<Index>(figure.panels.size()))
        throw InvalidArgument("panel {} does not exist: the figure has {}", number, figure.panels.size());
    return figure.panels[static_cast<std::size_t>(number - 1)];
}

/// The panel that argument `index` numbers; default: the first one.
Panel& panel_argument(Call& call, int index) {
    return panel_of(figure_self(call), call.given(index) ? call.integer(index, "panel") : 1);
}

/// What an author wrote; empty where the argument is not given.
Message given_label(const Call& call, int index, const char* what) {
    return call.given(index) ? Message::verbatim(call.text(index, what)) : Message();
}

/// Methods give the figure back, so that they can be chained.
int give_self(Call& call) {
    lua_pushvalue(call.state(), 1);
    return 1;
}

/// fig:add(x, y, {label =, style =, panel =, ...})
int add_curve(Call& call) {
    call.at_most(4);
    const Options options(call, 4, kAddTables);
    Curve curve;
    curve.x = call.vector(2, "x");
    curve.y = call.vector(3, "y");
    curve.label = Message::verbatim(options.text("label", ""));
    read_curve_appearance(options, curve);
    panel_of(figure_self(call), options.size("panel", 1)).curves.push_back(std::move(curve));
    figure_self(call).validate();
    return give_self(call);
}

/// fig:mark(x, y, text, panel)
int add_mark(Call& call) {
    call.at_most(5);
    Annotation mark{call.number(2, "x"), call.number(3, "y"), given_label(call, 4, "text"), true};
    panel_argument(call, 5).annotations.push_back(std::move(mark));
    return give_self(call);
}

constexpr Index kScaleNumbers = 21;

/// Numbers of a slider, from end to end, evenly or over the logarithm.
Vector slider_numbers(const RecordedSlider& slider) {
    if (!slider.logarithmic) return Vector::LinSpaced(kScaleNumbers, slider.from, slider.to);
    Vector numbers =
        Vector::LinSpaced(kScaleNumbers, std::log(slider.from), std::log(slider.to)).array().exp().matrix();
    numbers[0] = slider.from, numbers[kScaleNumbers - 1] = slider.to;
    return numbers;
}

/// What the script's function on top of the stack gives for a slider's number; it stays there.
double place_at(const Call& call, double number, const char* coordinate) {
    lua_State* L = call.state();
    lua_pushvalue(L, -1);
    lua_pushnumber(L, number);
    lua_call(L, 1, 1);
    if (lua_type(L, -1) != LUA_TNUMBER)
        throw InvalidArgument("the function '{}' of the handle must return a number, but for {} it returned {}",
                              coordinate, number, given_value(L, lua_gettop(L)));
    const double place = lua_tonumber(L, -1);
    lua_pop(L, 1);
    return place;
}

const RecordedSlider& slider_of_handle(const Options& options, const std::string& coordinate) {
    const std::string key = coordinate + "_slider", name = options.text(key.c_str(), "");
    const auto& sliders = options.call().context().recorder.record().sliders;
    const auto found = sliders.find(name);
    if (found != sliders.end()) return found->second;
    if (name.empty())
        throw InvalidArgument("'{}' is a function, so the option {} = \"NAME\" must name its slider", coordinate, key);
    throw InvalidArgument("the slider \"{}\" does not exist yet: call slider(\"{}\", ...) before you create the handle",
                          name, name);
}

/// A coordinate of a handle: a number, or a function of the slider that is named beside it.
double handle_coordinate(const Options& options, const char* coordinate, bool horizontal, Annotation& handle) {
    const Call& call = options.call();
    const std::string key = std::string(coordinate) + "_slider";
    const int given = options.push(coordinate);
    const bool is_function = lua_type(call.state(), given) == LUA_TFUNCTION;
    if (!is_function) {
        lua_settop(call.state(), given - 1);
        const auto number = options.optional_number(coordinate);
        if (!number || options.has(key.c_str()))
            throw InvalidArgument("a handle needs {} = number, or {} = function(slider value) and {} = \"NAME\"",
                                  coordinate, coordinate, key);
        return *number;
    }
    const RecordedSlider& slider = slider_of_handle(options, coordinate);
    SliderScale scale{options.text(key.c_str(), ""), horizontal, slider.value, slider_numbers(slider), {}};
    scale.places.resize(scale.values.size());
    for (Index i = 0; i < scale.values.size(); ++i) scale.places[i] = place_at(call, scale.values[i], coordinate);
    const double here = place_at(call, slider.value, coordinate);
    lua_settop(call.state(), given - 1);
    const Vector steps = scale.places.tail(kScaleNumbers - 1) - scale.places.head(kScaleNumbers - 1);
    if (!scale.places.allFinite() || !((steps.array() > 0).all() || (steps.array() < 0).all()))
        throw InvalidArgument("the function '{}' of the handle must be monotonic for the slider \"{}\" from {} to {}",
                              coordinate, scale.slider, slider.from, slider.to);
    handle.scales.push_back(std::move(scale));
    return here;
}

/// fig:handle{x = function or number, x_slider =, y =, y_slider =, text =, panel =}
int add_handle(Call& call) {
    call.at_most(2);
    const Options options(call, 2, kHandleTables);
    Annotation handle;
    handle.x = handle_coordinate(options, "x", true, handle);
    handle.y = handle_coordinate(options, "y", false, handle);
    handle.text = Message::verbatim(options.text("text", ""));
    if (handle.scales.empty())
        throw InvalidArgument(
            "x or y of a handle must be a function of the slider value; for a fixed point, use fig:mark");
    panel_of(figure_self(call), options.size("panel", 1)).annotations.push_back(std::move(handle));
    figure_self(call).validate();
    return give_self(call);
}

template <bool kHorizontal>
int add_reference(Call& call) {
    call.at_most(4);
    const ReferenceLine line{kHorizontal, call.number(2, kHorizontal ? "y" : "x"), given_label(call, 3, "label"), 1};
    panel_argument(call, 4).references.push_back(line);
    return give_self(call);
}

/// Lines at all steps between the ends, as one curve with gaps; `upright`: at places on the x-axis.
Curve ruled_lines(std::pair<double, double> along, double step, std::pair<double, double> across, bool upright) {
    const auto lines = static_cast<Index>(std::floor((along.second - along.first) / step + 1e-6)) + 1;
    Vector places(3 * lines), ends(3 * lines);
    for (Index i = 0; i < lines; ++i) {
        places.segment(3 * i, 3).setConstant(along.first + static_cast<double>(i) * step);
        ends.segment(3 * i, 3) << across.first, across.second, std::nan("");
    }
    Curve curve;
    curve.x = upright ? places : ends;
    curve.y = upright ? ends : places;
    curve.color = style::kGrayColor;
    curve.dash = 0;
    return curve;
}

/// fig:rule(dx, dy, panel): graph paper, every fifth line of which is heavier
int rule_paper(Call& call) {
    call.at_most(4);
    constexpr double kMaxLineCount = 2000;
    const double steps[] = {call.number(2, "dx"), call.number(3, "dy")};
    Panel& panel = panel_argument(call, 4);
    if (!panel.x_range || !panel.y_range)
        throw InvalidArgument("fig:rule needs the ranges of its panel: set x_range and y_range first");
    const std::pair<double, double> ranges[] = {*panel.x_range, *panel.y_range};
    for (const int axis : {0, 1})
        if (const double size = ranges[axis].second - ranges[axis].first;
            !(steps[axis] > 0) || size / steps[axis] > kMaxLineCount)
            throw InvalidArgument(
                "fig:rule: {} must be a positive number that results in at most {} lines, but {} was given",
                axis == 0 ? "dx" : "dy", kMaxLineCount, steps[axis]);
    for (const auto& [times, width] : {std::pair(1., 0.15), std::pair(5., 0.45)})
        for (const int axis : {0, 1}) {
            panel.curves.push_back(ruled_lines(ranges[axis], times * steps[axis], ranges[1 - axis], axis == 0));
            panel.curves.back().line_width = width;
        }
    return give_self(call);
}

/// fig:arrow(x0, y0, x1, y1, text, panel)
int add_arrow(Call& call) {
    call.at_most(7);
    const Arrow arrow{call.number(2, "x0"), call.number(3, "y0"),         call.number(4, "x1"),
                      call.number(5, "y1"), given_label(call, 6, "text"), true};
    panel_argument(call, 7).arrows.push_back(arrow);
    return give_self(call);
}

/// fig:set{title =, xlabel =, ..., panel =}
int set_options(Call& call) {
    call.at_most(2);
    const Options options(call, 2, kSetTables);
    Figure& figure = figure_self(call);
    read_panel_options(call, options, panel_of(figure, options.size("panel", 1)));
    options.read(figure);
    figure.validate();
    return give_self(call);
}

int figure_to_text(Call& call) {
    const Figure& figure = figure_self(call);
    std::size_t curves = 0;
    for (const Panel& panel : figure.panels) curves += panel.curves.size();
    return call.give(localized(
        call,
        Message("figure: {}, {}", plural(static_cast<std::int64_t>(figure.panels.size()), "{} panel", "{} panels"),
                plural(static_cast<std::int64_t>(curves), "{} curve", "{} curves"))));
}

int panel_count(Call& call) {
    return call.give_integer(static_cast<Index>(figure_self(call).panels.size()));
}

/// fig.curves: what is drawn, a table {panel =, label =, x =, y =} for each curve, with y_upper for a band. Labels are
/// English, as scripts compare them.
int list_of_curves(Call& call) {
    lua_State* L = call.state();
    const Figure& figure = figure_self(call);
    lua_newtable(L);
    lua_Integer place = 0;
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
        for (const Curve& curve : figure.panels[i].curves) {
            give_table(call, "panel", static_cast<Index>(i + 1), "label", message_text(curve.label), "x", curve.x, "y",
                       curve.y);
            if (curve.y_upper.size() > 0) set_field(call, "y_upper", curve.y_upper);
            lua_rawseti(L, -2, ++place);
        }
    return 1;
}

constexpr std::array kFigureTypeFields = {Member{"panels", guarded<panel_count>},
                                          Member{"curves", guarded<list_of_curves>}};
constexpr std::array kFigureTypeMethods = {Member{"add", guarded<add_curve>},
                                           Member{"mark", guarded<add_mark>},
                                           Member{"handle", guarded<add_handle>},
                                           Member{"hline", guarded<add_reference<true>>},
                                           Member{"vline", guarded<add_reference<false>>},
                                           Member{"arrow", guarded<add_arrow>},
                                           Member{"rule", guarded<rule_paper>},
                                           Member{"set", guarded<set_options>}};
constexpr std::array kFigureTypeOperators = {Member{"__tostring", guarded<figure_to_text>}};

constexpr std::array kFigureTypes = {
    TypeEntry{&Userdata<FigurePointer>::type, kFigureTypeFields, kFigureTypeMethods, kFigureTypeOperators}};

}  // namespace

TypeEntries figure_types() {
    return kFigureTypes;
}

}  // namespace dynlab::inline scripting
