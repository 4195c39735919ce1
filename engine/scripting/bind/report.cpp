#include <array>
#include <cctype>
#include <cmath>

#include "scripting/bind/bindings.h"
#include "scripting/conversions/arguments.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/option_member.h"
#include "scripting/objects/figure_object.h"
#include "scripting/runtime/sandbox.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kSliderOptions = {
    option<&RecordedSlider::step>(
        "step", about("step between positions; by default, every number in the range can be selected")),
    option<&RecordedSlider::logarithmic>(
        "log", about("true spaces the positions equally on a logarithmic scale; cannot be combined with `step`")),
    option<&RecordedSlider::unit>("unit", about("unit after the number")),
    option<&RecordedSlider::label>("label", about("text next to the slider; by default, the name"))};
constexpr OptionTable kSliderTables[] = {kSliderOptions};

constexpr ArgumentEntry kEntryName = {
    "name", ValueKind::kText, about("name of the entry, made of letters, digits, _ and -; use each name only once")};
constexpr std::array kReportValueArguments = {
    kEntryName, ArgumentEntry{"x", ValueKind::kAny, about("number or text")},
    ArgumentEntry{"format", ValueKind::kText,
                  about("format of a number, such as \"%.2f\"; by default chosen from the number")}};
constexpr std::array kReportTableArguments = {
    kEntryName, ArgumentEntry{"{{title, ...}, {cell, ...}, ...}", ValueKind::kTable,
                              about("rows of strings or numbers; the first row contains the column titles. A string "
                                    "can contain formulas between dollar signs, such as \"$a_1$\"")}};
constexpr std::array kReportFigureArguments = {
    kEntryName, ArgumentEntry{"fig", ValueKind::kAny, about("figure")},
    ArgumentEntry{"caption", ValueKind::kText, about("caption, used only in documents that do not specify a caption")}};
constexpr std::array kReportTextArguments = {kEntryName,
                                             ArgumentEntry{"markdown", ValueKind::kText, about("text in Markdown")}};
constexpr std::array kSliderArguments = {
    ArgumentEntry{"name", ValueKind::kText,
                  about("name of the slider: letters, digits, _ and -; use each name only once")},
    ArgumentEntry{"x", ValueKind::kNumber, about("number that the script uses until the reader selects another")},
    ArgumentEntry{"from", ValueKind::kNumber, about("smallest number; positive if `log` is true")},
    ArgumentEntry{"to", ValueKind::kNumber, about("largest number")}};
constexpr std::array kPredictionArguments = {
    ArgumentEntry{"name", ValueKind::kText, about("name of the prediction, for `reveal`; use each name only once")},
    ArgumentEntry{"value", ValueKind::kNumber, about("your prediction, or nil if you have none yet")},
    ArgumentEntry{"unit", ValueKind::kText, about("unit after the numbers")}};
constexpr std::array kRevealArguments = {
    ArgumentEntry{"name", ValueKind::kText, about("name of a prediction stored by `predict_first`")},
    ArgumentEntry{"value", ValueKind::kNumber, about("result, in the unit of the prediction")}};

/// The name under which documents find an entry; each is given once per kind.
template <class Taken>
std::string new_name(const Call& call, const Taken& taken) {
    std::string name = call.text(1, "name");
    const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-';
    });
    if (!plain) throw InvalidArgument("the name \"{}\" is not valid: use only letters, digits, _ and -", name);
    if (taken(name))
        throw InvalidArgument("the name \"{}\" is already used by an entry of this kind; choose another name", name);
    return name;
}

/// A number without a format: integers as they are.
std::string cell_text(lua_State* L, int index) {
    const bool fraction = lua_type(L, index) == LUA_TNUMBER && lua_isinteger(L, index) == 0;
    return fraction ? number_text(lua_tonumber(L, index)) : value_text(L, index);
}

/// string.format(format, value at `index`)
std::string formatted(const Call& call, const std::string& format, int index) {
    lua_State* L = call.state();
    push_library(L);
    lua_getfield(L, -1, "string");
    lua_getfield(L, -1, "format");
    lua_pushlstring(L, format.data(), format.size());
    lua_pushvalue(L, index);
    if (lua_pcall(L, 2, 1, 0) == LUA_OK) return lua_tostring(L, -1);
    pass_stop_on(L);
    throw InvalidArgument("{} must be a format for one value, such as \"%.3f\", but \"{}\" cannot format {}",
                          argument_label(3, "format"), format, given_value(L, index));
}

/// A number that a format made look like less than zero, or like none, as displays show it.
std::string formatted_number(const Call& call, const std::string& format, int index) {
    const double number = lua_tonumber(call.state(), index);
    const bool integer = lua_isinteger(call.state(), index) != 0;
    if (!integer && !std::isfinite(number)) return number_text(number);
    const std::string text = formatted(call, format, index);
    const bool zero = text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos;
    return zero ? text.substr(1) : text;
}

int report_value(Call& call) {
    call.at_most(3);
    auto& values = call.context().recorder.record().values;
    const std::string name = new_name(call, [&](const std::string& n) { return values.count(n) != 0; });
    RecordedValue value;
    if (call.type(2) == LUA_TNUMBER) {
        value.number = call.number(2, "value");
        value.text = call.given(3) ? formatted_number(call, call.text(3, "format"), 2) : cell_text(call.state(), 2);
    } else if (call.type(2) == LUA_TSTRING) {
        value.text = call.given(3) ? formatted(call, call.text(3, "format"), 2) : call.text(2, "value");
    } else {
        wrong_argument(call.state(), 2, "value", Message("a number or text"));
    }
    values[name] = std::move(value);
    return 0;
}

std::vector<std::string> read_cells(const Call& call, int row, lua_Integer number) {
    lua_State* L = call.state();
    if (lua_type(L, row) != LUA_TTABLE)
        throw InvalidArgument("row {} must be {}, but {} was given", number, Message("a table of cells"),
                              given_value(L, row));
    std::vector<std::string> cells;
    for (lua_Integer i = 1; lua_rawgeti(L, row, i) != LUA_TNIL; lua_pop(L, 1), ++i) cells.push_back(cell_text(L, -1));
    lua_pop(L, 1);
    return cells;
}

int report_table(Call& call) {
    call.at_most(2);
    auto& tables = call.context().recorder.record().tables;
    const std::string name = new_name(call, [&](const std::string& n) { return tables.count(n) != 0; });
    if (call.type(2) != LUA_TTABLE)
        wrong_argument(call.state(), 2, "rows", Message("a list of rows, with the header first"));
    RecordedTable table;
    lua_State* L = call.state();
    for (lua_Integer i = 1; lua_rawgeti(L, 2, i) != LUA_TNIL; lua_pop(L, 1), ++i) {
        std::vector<std::string> cells = read_cells(call, lua_gettop(L), i);
        if (i == 1) table.header = cells;
        if (cells.size() != table.header.size())
            throw InvalidArgument("row {} has {}, but the header has {}; all rows must have the same number of cells",
                                  i, plural(cells.size(), "{} cell", "{} cells"), table.header.size());
        if (i > 1) table.rows.push_back(std::move(cells));
    }
    if (table.header.empty())
        throw InvalidArgument("the table has no header; its first row must contain the column titles");
    tables[name] = std::move(table);
    return 0;
}

int report_figure(Call& call) {
    call.at_most(3);
    Recorder& recorder = call.context().recorder;
    const std::string name = new_name(call, [&](const std::string& n) { return recorder.has_reported_figure(n); });
    const FigurePointer& figure = object_argument<FigurePointer>(call, 2, "figure");
    recorder.report_figure(name, figure, call.given(3) ? call.text(3, "caption") : "");
    return 0;
}

int report_text(Call& call) {
    call.at_most(2);
    auto& texts = call.context().recorder.record().texts;
    const std::string name = new_name(call, [&](const std::string& n) { return texts.count(n) != 0; });
    texts[name] = {call.text(2, "Markdown")};
    return 0;
}

int report_language(Call& call) {
    call.at_most(0);
    return call.give(call.context().services.language_code());
}

void check_range(const std::string& name, const RecordedSlider& slider) {
    if (!(slider.from < slider.to) || !std::isfinite(slider.from) || !std::isfinite(slider.to))
        throw InvalidArgument("the range of the slider \"{}\" must increase, but it is from {} to {}", name,
                              slider.from, slider.to);
    if (slider.logarithmic && slider.from <= 0)
        throw InvalidArgument("the slider \"{}\" has log = true and must start at a positive number, not at {}", name,
                              slider.from);
    if (slider.step && !(*slider.step > 0 && *slider.step <= slider.to - slider.from))
        throw InvalidArgument("the step of the slider \"{}\" must be greater than 0 and at most {}, not {}", name,
                              slider.to - slider.from, *slider.step);
    for (const double value : {slider.initial, slider.value})
        if (!(value >= slider.from && value <= slider.to))
            throw InvalidArgument("the value of the slider \"{}\" must be between {} and {}, but it is {}", name,
                                  slider.from, slider.to, value);
}

int slider(Call& call) {
    call.at_most(5);
    Recorder& recorder = call.context().recorder;
    const std::string name =
        new_name(call, [&](const std::string& n) { return recorder.record().sliders.count(n) != 0; });
    RecordedSlider slider;
    slider.initial = call.number(2, "value");
    slider.from = call.number(3, "from");
    slider.to = call.number(4, "to");
    slider.label = name;
    Options(call, 5, kSliderTables).read(slider);
    if (slider.step && slider.logarithmic)
        throw InvalidArgument("the slider \"{}\" cannot have both log = true and a step; omit one of these options",
                              name);
    const SliderValues* const given = call.context().services.sliders;
    const SliderValues values = given != nullptr ? *given : SliderValues();
    const auto found = values.chosen.find(name);
    slider.value = found == values.chosen.end() ? slider.initial : found->second;
    if (values.clamped && slider.from < slider.to) slider.value = std::clamp(slider.value, slider.from, slider.to);
    check_range(name, slider);
    recorder.add_slider(name, slider);
    const auto is_whole = [](double number) { return number == std::floor(number) && std::abs(number) < 1e15; };
    const bool counts = slider.step && is_whole(*slider.step) && is_whole(slider.from) && is_whole(slider.value);
    return counts ? call.give_integer(static_cast<std::int64_t>(slider.value)) : call.give(slider.value);
}

constexpr const char* kPredictions = "dynlab guesses";  // in Lua's registry: a table for each name

/// Pushes the table of all predictions.
void push_predictions(lua_State* L) {
    luaL_getsubtable(L, LUA_REGISTRYINDEX, kPredictions);
}

Message with_unit(double value, const std::string& unit) {
    const Number number = significant(value, 4);
    return unit.empty() ? Message("{}", number) : Message("{} {}", number, unit);
}

/// The distance of a prediction from the result, in percent of the result; for a quantity in percent, in percentage
/// points. Empty if the distance has no meaning.
Message distance(double guessed, double found, const std::string& unit) {
    if (!std::isfinite(found) || !std::isfinite(guessed)) return {};
    if (unit == "%") {
        const double points = std::abs(guessed - found);
        const bool shown_as_one = points >= 0.995 && points < 1.05;
        return shown_as_one ? Message("off by 1 percentage point")
                            : Message("off by {} percentage points", significant(points, 2));
    }
    if (found == 0) return {};
    const double percent = 100 * std::abs(guessed / found - 1);
    if (percent >= 9.5) return Message("off by {} %", decimals(percent, 0));
    if (percent >= 0.01 || percent == 0) return Message("off by {} %", significant(percent, 1));
    return Message("off by less than {} %", significant(0.01, 1));
}

int predict_first(Call& call) {
    call.at_most(3);
    lua_State* const L = call.state();
    const std::string name = call.text(1, "name");
    const std::string unit = call.given(3) ? call.text(3, "unit") : "";
    push_predictions(L);
    if (lua_getfield(L, -1, name.c_str()) != LUA_TNIL)
        throw InvalidArgument(
            "the prediction \"{}\" already exists; enter each prediction only once, before you see the result", name);
    lua_pop(L, 1);
    lua_createtable(L, 0, 2);
    if (call.given(2)) {
        lua_pushnumber(L, call.number(2, Message("your prediction")));
        lua_setfield(L, -2, "value");
    } else {
        call.print(localized(call, Message("{}: no prediction yet; replace nil with your number", name)) + "\n");
    }
    lua_pushstring(L, unit.c_str());
    lua_setfield(L, -2, "unit");
    lua_setfield(L, -2, name.c_str());
    return 0;
}

int reveal(Call& call) {
    call.at_most(2);
    lua_State* const L = call.state();
    const std::string name = call.text(1, "name");
    const double found = call.number(2, Message("result"));
    push_predictions(L);
    if (lua_getfield(L, -1, name.c_str()) != LUA_TTABLE)
        throw InvalidArgument("no prediction is named \"{}\"; write predict_first(\"{}\", NUMBER) first", name, name);
    lua_getfield(L, -1, "unit");
    const std::string unit = lua_tostring(L, -1);
    const Message shown = with_unit(found, unit);
    if (lua_getfield(L, -2, "value") == LUA_TNIL) {
        call.print(localized(call, Message("{}: result {}, no prediction", name, shown)) + "\n");
        return 0;
    }
    const double guessed = lua_tonumber(L, -1);
    const Message off = distance(guessed, found, unit), own = with_unit(guessed, unit);
    call.print(localized(call, off.empty() ? Message("{}: prediction {}, result {}", name, own, shown)
                                           : Message("{}: prediction {}, result {} ({})", name, own, shown, off)) +
               "\n");
    return 0;
}

constexpr FunctionEntry kReportFunctions[] = {
    {"report.value", "report", "report.value(name, x, format)", "Add a number or text to the report",
     guarded<report_value>, kNoOptions, kReportValueArguments},
    {"report.table", "report", "report.table(name, {{title, ...}, {cell, ...}, ...})", "Add a table to the report",
     guarded<report_table>, kNoOptions, kReportTableArguments},
    {"report.figure", "report", "report.figure(name, fig, caption)", "Add a figure to the report",
     guarded<report_figure>, kNoOptions, kReportFigureArguments},
    {"report.text", "report", "report.text(name, markdown)", "Add Markdown text to the report", guarded<report_text>,
     kNoOptions, kReportTextArguments},
    {"report.language", "report", "report.language() -> text", "Return the language of the report",
     guarded<report_language>},
    {"slider", "report", "slider(name, x, from, to, {options}) -> x",
     "Create a number that the reader of a page can change", guarded<slider>, kSliderTables, kSliderArguments},
    {"predict_first", "report", "predict_first(name, value, unit)", "Store your prediction before you see the result",
     guarded<predict_first>, kNoOptions, kPredictionArguments},
    {"reveal", "report", "reveal(name, value)", "Print a prediction next to the result", guarded<reveal>, kNoOptions,
     kRevealArguments},
};

}  // namespace

FunctionEntries report_functions() {
    return kReportFunctions;
}

}  // namespace dynlab::inline scripting
