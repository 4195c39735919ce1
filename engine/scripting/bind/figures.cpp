#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "figures/figure_text.h"
#include "figures/gnuplot_renderer.h"
#include "figures/gnuplot_script.h"
#include "figures/plots/motion_plot.h"
#include "platform/atomic_file.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/panel_options.h"
#include "scripting/objects/plant_drawing.h"
#include "scripting/runtime/output_path.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kCurveLists = {
    OptionEntry{"label", ValueKind::kAny, about("name of the curve in the legend, or a list with one for each curve")},
    OptionEntry{"style",
                ValueKind::kAny,
                about("\"line\", \"points\", \"line_points\", \"stairs\", \"stems\" or \"bars\", for all curves or as "
                      "a list with one per curve"),
                {.initial = "\"line\"", .choices = kCurveStyles}},
    OptionEntry{"color", ValueKind::kAny,
                about("number in the palette, starting at 0, or a name such as \"red\", for all curves or as a list "
                      "with one per curve")},
    OptionEntry{"dash", ValueKind::kVector,
                about("dash pattern for all curves, or a list with one per curve: 0 solid, 1 dashed, 2 dotted, 3 "
                      "dash-dot, 4 to 7 further patterns")},
    OptionEntry{
        "marker", ValueKind::kVector,
        about("marker for all curves, or a list with one per curve: 0 dot, 1 square, 2 triangle, 3 diamond, 4 to 7 the "
              "same shapes unfilled, 8 cross, 9 plus, 10 asterisk")},
    option<&Curve::line_width>("line_width", about("line width"), {.unit = "points"})};
constexpr std::array kFigureGridOptions = {
    OptionEntry{"panels", ValueKind::kTable, about("list of panels, each a table of the options of one panel")},
    OptionEntry{"rows", ValueKind::kCount, about("number of rows of panels; by default as many as necessary")},
    OptionEntry{"columns", ValueKind::kCount, about("number of columns of panels"), {.initial = "1"}}};
constexpr std::array kMotionOptions = {
    OptionEntry{"plant", ValueKind::kText, about("name of the plant, such as \"crane\"")},
    OptionEntry{"t", ValueKind::kVector, about("increasing sampling instants"), {.unit = "s"}},
    OptionEntry{"measured", ValueKind::kTable,
                about("measured signals of the plant, a table with one vector per signal")},
    OptionEntry{"simulated", ValueKind::kTable,
                about("simulated signals of the plant, a table with one vector per signal")},
    option<&MotionAppearance::instants>(
        "instants", about("instants of the drawings in a printed document; by default, four equally spaced instants"),
        {.unit = "s"}),
    OptionEntry{"title", ValueKind::kText, about("text above the figure")},
    option<&MotionAppearance::width_cm>("width", about("width of the figure"), {.unit = "cm"}),
    option<&MotionAppearance::height_cm>("height", about("height of the figure; 0 for a height that fits the panels"),
                                         {.unit = "cm"})};
/// The options of a panel with other defaults of x_log and y_log.
constexpr auto panel_options_with_scales(bool log_x, bool log_y) {
    auto options = kPanelOptions;
    for (OptionEntry& option : options) {
        const std::string_view name = option.name;
        if ((log_x && name == "x_log") || (log_y && name == "y_log")) option.facts.initial = "true";
    }
    return options;
}
constexpr std::array kLogXOptions = panel_options_with_scales(true, false),
                     kLogYOptions = panel_options_with_scales(false, true),
                     kLogLogOptions = panel_options_with_scales(true, true);
constexpr OptionTable kPlotTables[] = {kPanelOptions, kCurveLists, kFigureSizeOptions},
                      kLogXTables[] = {kLogXOptions, kCurveLists, kFigureSizeOptions},
                      kLogYTables[] = {kLogYOptions, kCurveLists, kFigureSizeOptions},
                      kLogLogTables[] = {kLogLogOptions, kCurveLists, kFigureSizeOptions},
                      kFigureTables[] = {kPanelOptions, kFigureGridOptions, kFigureSizeOptions},
                      kMotionTables[] = {kMotionOptions};

constexpr std::array kCurvesArguments = {
    ArgumentEntry{"x, y, \"name\", ...", ValueKind::kVector,
                  about("curves and their names in the legend. You can omit the names and x; without x, the values are "
                        "plotted versus their index")}};
constexpr std::array kFigureNumberArguments = {
    ArgumentEntry{"n", ValueKind::kCount, about("number of the next figure, instead of a description")}};
constexpr std::array kSubplotArguments = {
    ArgumentEntry{"rows", ValueKind::kCount, about("number of rows of panels")},
    ArgumentEntry{"columns", ValueKind::kCount, about("number of columns of panels")},
    ArgumentEntry{"{fig1, fig2, ...}", ValueKind::kAny, about("figures, row by row")}};
constexpr std::array kSaveFigureArguments = {
    ArgumentEntry{"fig", ValueKind::kAny, about("figure")},
    ArgumentEntry{"path", ValueKind::kText,
                  about("file name ending in .pdf, .svg, .png or .gp, in the script's folder, the output folder or one "
                        "of their subfolders")}};

/// Options of plot that hold one value for all curves or one per curve.
struct CurveLists {
    std::vector<std::string> labels, styles;
    std::vector<double> dashes, markers;
    std::vector<int> colors;
};

std::vector<double> numbers(const Options& options, const char* name) {
    if (!options.has(name)) return {};
    lua_State* L = options.call().state();
    if (lua_type(L, options.push(name)) == LUA_TNUMBER) return {options.number(name, 0)};
    const VectorMap list = options.vector(name);
    return {list.begin(), list.end()};
}

/// The number as an index into a list of looks.
int place_of_look(double number, const char* name) {
    if (number < 0 || number != std::floor(number) || number > 1000)
        refuse_option(name, Message("a nonnegative integer"), Message("{}", number));
    return static_cast<int>(number);
}

/// The value for curve `i` of `count`: the only one, or its own.
template <class T>
const T* value_for(const std::vector<T>& values, std::size_t i, std::size_t count, const char* name) {
    if (values.empty()) return nullptr;
    if (values.size() == 1) return &values.front();
    if (values.size() != count)
        throw InvalidArgument("option '{}' has {} for {}; the two numbers must be equal", name,
                              plural(values.size(), "{} value", "{} values"), plural(count, "{} curve", "{} curves"));
    return &values[i];
}

void read_curve_lists(const Options& options, std::vector<Curve>& curves) {
    const CurveLists lists{options.texts("label"), options.texts("style"), numbers(options, "dash"),
                           numbers(options, "marker"), colors_of(options)};
    if (lists.labels.size() > curves.size())
        throw InvalidArgument("option 'label' has {} for {}; specify at most one string per curve",
                              plural(lists.labels.size(), "{} string", "{} strings"),
                              plural(curves.size(), "{} curve", "{} curves"));
    for (std::size_t i = 0; i < curves.size(); ++i) {
        Curve& curve = curves[i];
        if (i < lists.labels.size()) curve.label = Message::verbatim(with_marked_indices(lists.labels[i]));
        if (auto style = value_for(lists.styles, i, curves.size(), "style")) curve.style = parse_curve_style(*style);
        if (auto dash = value_for(lists.dashes, i, curves.size(), "dash")) curve.dash = place_of_look(*dash, "dash");
        if (auto marker = value_for(lists.markers, i, curves.size(), "marker"))
            curve.marker = place_of_look(*marker, "marker");
        if (auto color = value_for(lists.colors, i, curves.size(), "color")) curve.color = *color;
        options.read(curve);
    }
}

/// MATLAB's line specification: "--", "r:", ".-", or a color with a marker such as "ro".
bool is_line_specification(const std::string& text) {
    if (text.empty() || text.size() > 3 || text.find_first_not_of("-:.ox+*sdrgbkmcy") != std::string::npos)
        return false;
    if (text.find_first_of("-:.+*") != std::string::npos) return true;
    const auto is_one_of = [](char letter, std::string_view letters) { return letters.find(letter) != letters.npos; };
    return text.size() == 2 && is_one_of(text[0], "rgbkmcy") && is_one_of(text[1], "oxsd");
}

std::string curve_name(const Call& call, int index) {
    const std::string name = call.text(index, Message("name of the curve"));
    static constexpr std::array kProperties = {"LineWidth",  "LineStyle",   "Color",          "Marker",
                                               "MarkerSize", "DisplayName", "MarkerFaceColor"};
    if (std::find(kProperties.begin(), kProperties.end(), name) != kProperties.end())
        throw InvalidArgument(
            "\"{}\" is an option of MATLAB's plot; write the options as one table, plot(x, y, {line_width = 2, color "
            "= \"red\", style = \"points\"})",
            name);
    if (is_line_specification(name))
        throw InvalidArgument(
            "a string is the name of the curve; for the style \"{}\", use {style = \"points\"} or {dash = 1}", name);
    return name;
}

/// x1, y1, "name", x2, y2, "name", ... up to the options; a single vector is drawn over 1, 2, 3, ...
std::vector<Curve> read_curves(const Call& call, int last) {
    std::vector<Curve> curves;
    for (int i = 1; i <= last;) {
        Curve curve;
        const bool alone = i == last || !call.holds_vector(i + 1);
        const VectorMap first = call.vector(i, alone ? "y" : "x");
        curve.y = alone ? first : call.vector(i + 1, "y");
        curve.x = alone ? Vector(Vector::LinSpaced(first.size(), 1, static_cast<double>(first.size()))) : Vector(first);
        i += alone ? 1 : 2;
        if (i <= last && call.type(i) == LUA_TSTRING) curve.label = Message::verbatim(curve_name(call, i++));
        curves.push_back(std::move(curve));
    }
    if (curves.empty())
        throw InvalidArgument(
            "plot has nothing to draw; write plot(x, y) or plot(x, y, \"name\", {xlabel = \"time (s)\"})");
    return curves;
}

bool holds_options(const Call& call, int index) {
    return index > 0 && call.type(index) == LUA_TTABLE && !call.holds_vector(index);
}

/// Says how many values a logarithmic axis cannot show.
void note_left_out(const Call& call, const Panel& panel) {
    Index left_out = 0, all = 0;
    for (const Curve& curve : panel.curves) {
        all += curve.y.size();
        for (Index i = 0; i < curve.y.size(); ++i)
            left_out += (panel.log_y && !(curve.y[i] > 0)) || (panel.log_x && !(curve.x[i] > 0)) ? 1 : 0;
    }
    if (left_out > 0)
        call.print(
            localized(
                call,
                Message("{}: the figure omits {} of {} points, because a logarithmic axis shows only positive values",
                        call.function_name(), left_out, all)) +
            "\n");
}

/// plot, and the same with logarithmic axes.
template <bool kLogX, bool kLogY>
int plot(Call& call) {
    const bool with_options = holds_options(call, call.count());
    Panel panel;
    panel.curves = read_curves(call, call.count() - (with_options ? 1 : 0));
    const Options options(call, with_options ? call.count() : call.count() + 1, kPlotTables);
    read_curve_lists(options, panel.curves);
    panel.log_x = kLogX;
    panel.log_y = kLogY;
    read_panel_options(call, options, panel);
    Figure figure(std::move(panel));
    options.read(figure);
    figure.validate();  // x and y are of one length from here on
    note_left_out(call, figure.panels.front());
    return give_figure(call, std::move(figure));
}

/// Of rows or columns; what is too large for a figure stays so as an int.
int count_in_grid(Index count) {
    return static_cast<int>(std::min<Index>(count, 1 << 20));
}

/// The panels of figure{...}: those under `panels`, or the one the table itself describes.
std::vector<Panel> described_panels(const Call& call, const Options& options) {
    lua_State* L = call.state();
    std::vector<Panel> panels;
    const int list = options.push("panels");
    if (lua_isnil(L, list)) {
        read_panel_options(call, options, panels.emplace_back());
    } else {
        for (lua_Integer i = 1; lua_rawgeti(L, list, i) != LUA_TNIL; lua_settop(L, list), ++i)
            panels.push_back(read_panel(call, lua_gettop(L)));
    }
    lua_settop(L, list - 1);
    return panels;
}

int figure(Call& call) {
    call.at_most(1);
    if (!call.given(1)) return 0;
    if (call.type(1) == LUA_TNUMBER) {
        call.context().recorder.set_next_figure_number(call.integer(1, "number"));
        return 0;
    }
    const Options options(call, 1, kFigureTables);
    Figure figure;
    figure.panels = described_panels(call, options);
    figure.columns = count_in_grid(options.size("columns", 1));
    const auto columns = static_cast<std::size_t>(std::max(figure.columns, 1));
    figure.rows =
        count_in_grid(options.size("rows", static_cast<Index>((figure.panels.size() + columns - 1) / columns)));
    if (options.has("panels")) figure.title = Message::verbatim(options.text("title", ""));
    options.read(figure);
    return give_figure(call, std::move(figure));
}

int subplot(Call& call) {
    call.at_most(3);
    lua_State* L = call.state();
    Figure figure;
    figure.rows = count_in_grid(call.size(1, "rows"));
    figure.columns = count_in_grid(call.size(2, "columns"));
    if (call.type(3) != LUA_TTABLE)
        throw InvalidArgument("the figures must be a list, as in subplot(2, 1, {figure1, figure2}), but {} was given",
                              given_value(L, 3));
    for (lua_Integer i = 1; lua_rawgeti(L, 3, i) != LUA_TNIL; lua_pop(L, 1), ++i) {
        const FigurePointer* part = to_object<FigurePointer>(L, -1);
        if (part == nullptr)
            throw InvalidArgument("entry {} of the list must be a figure, but it is {}", i, given_value(L, -1));
        (*part)->used = true;
        figure.panels.insert(figure.panels.end(), (*part)->figure.panels.begin(), (*part)->figure.panels.end());
    }
    return give_figure(call, std::move(figure));
}

/// The signals of the plant's parts, one column each, from a table with a vector for each.
Matrix signals_of_parts(const Options& options, const char* name, const PlantDrawing& plant, Index count) {
    if (!options.has(name)) return {};
    const Call& call = options.call();
    const int table = options.push(name);
    if (lua_type(call.state(), table) != LUA_TTABLE)
        throw InvalidArgument("option '{}' must be a table such as {{} = y}, but it is {}", name,
                              plant.parts.front().signal, given_value(call.state(), table));
    Matrix signals(count, static_cast<Index>(plant.parts.size()));
    for (std::size_t k = 0; k < plant.parts.size(); ++k) {
        const PlantPart& part = plant.parts[k];
        if (lua_getfield(call.state(), table, part.signal.c_str()) == LUA_TNIL)
            throw InvalidArgument(
                "option '{}' does not contain the signal {} ({}), which the animation of the plant needs", name,
                part.signal, part.unit);
        const Call with_signal(call.state());  // it counts the current entries of the stack
        if (!with_signal.holds_vector(with_signal.count()))
            throw InvalidArgument("the {} {} must be a vector, but it is {}", name, part.signal,
                                  given_value(call.state(), with_signal.count()));
        const VectorMap signal = with_signal.vector(with_signal.count(), part.signal.c_str());
        if (signal.size() != count)
            throw InvalidArgument("the {} {} has {} for {}; specify one value per instant", name, part.signal,
                                  plural(signal.size(), "{} value", "{} values"),
                                  plural(count, "{} instant", "{} instants"));
        signals.col(static_cast<Index>(k)) = signal;
    }
    return signals;
}

int motion(Call& call) {
    call.at_most(1);
    const Options options(call, 1, kMotionTables);
    if (call.context().options.graded) return give_figure(call, Figure(Panel()));  // there are no drawings, and no eyes
    const PlantDrawing plant = plant_drawing(options.text("plant", ""));
    MotionData motion_data;
    motion_data.t = options.vector("t");
    motion_data.measured = signals_of_parts(options, "measured", plant, motion_data.t.size());
    motion_data.simulated = signals_of_parts(options, "simulated", plant, motion_data.t.size());
    MotionAppearance look;
    options.read(look);
    look.title = Message::verbatim(options.text("title", ""));
    return give_figure(call, motion_plot(plant, motion_data, look));
}

int save(Call& call) {
    call.at_most(2);
    if (call.type(1) == LUA_TSTRING)
        throw InvalidArgument(
            "the first argument of save must be a figure: save(fig, path); for variables, use save_mat(path, {x = x}) "
            "or save_csv");
    ScriptFigure& figure = used_figure(call, 1, "figure");
    const std::filesystem::path file = output_path(call.context(), call.text(2, "path"));
    if (call.context().options.graded) return 0;
    const Reader reader = reader_of(call);
    if (file.extension() == ".gp") {
        const std::string drawn = std::filesystem::path(file).replace_extension(".pdf").filename().string();
        write_file_atomically(file, gnuplot_file(figure.figure, FigureFormat::kPdf, drawn, reader));
        return 0;
    }
    const std::optional<FigureFormat> format = known_figure_format(file);
    if (!format)
        throw InvalidArgument("a figure must be saved as .pdf, .svg, .png or .gp, but the file name is \"{}\"",
                              file.filename().string());
    call.context().renderer.draw(figure.figure, file, *format, reader);
    return 0;
}

constexpr FunctionEntry kFiguresFunctions[] = {
    {"plot", "figures", "plot(x, y, \"name\", ..., {options}) -> fig", "Plot curves in one panel",
     guarded<plot<false, false>>, kPlotTables, kCurvesArguments},
    {"semilogx", "figures", "semilogx(x, y, \"name\", ..., {options}) -> fig", "Plot curves with a logarithmic x-axis",
     guarded<plot<true, false>>, kLogXTables, kCurvesArguments},
    {"semilogy", "figures", "semilogy(x, y, \"name\", ..., {options}) -> fig", "Plot curves with a logarithmic y-axis",
     guarded<plot<false, true>>, kLogYTables, kCurvesArguments},
    {"loglog", "figures", "loglog(x, y, \"name\", ..., {options}) -> fig", "Plot curves with two logarithmic axes",
     guarded<plot<true, true>>, kLogLogTables, kCurvesArguments},
    {"figure", "figures", "figure{options} -> fig; figure(n)",
     "Create a figure from a description, or set the number of the next figure", guarded<figure>, kFigureTables,
     kFigureNumberArguments},
    {"subplot", "figures", "subplot(rows, columns, {fig1, fig2, ...}) -> fig",
     "Combine figures as panels of one figure", guarded<subplot>, kNoOptions, kSubplotArguments},
    {"motion", "figures", "motion{options} -> fig", "Animate measured and simulated signals of a simulated plant",
     guarded<motion>, kMotionTables},
    {"save", "figures", "save(fig, path)", "Save a figure as .pdf, .svg, .png or .gp", guarded<save>, kNoOptions,
     kSaveFigureArguments},
};

}  // namespace

FunctionEntries figure_functions() {
    return kFiguresFunctions;
}

}  // namespace dynlab::inline scripting
