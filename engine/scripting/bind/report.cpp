#include <array>
#include <cctype>

#include "scripting/bind/bindings.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/text_form.h"
#include "scripting/runtime/report_language.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

/// The name under which documents find an entry; each is given once per kind.
template <class Taken>
std::string new_name(const Call& call, const Taken& taken) {
    std::string name = call.text(1, "name");
    const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-';
    });
    if (!plain) throw InvalidArgument(fmt::format("the name \"{}\" must be made of letters, digits, _ and -", name));
    if (taken(name))
        throw InvalidArgument(
            fmt::format("the name \"{}\" is taken already; every entry needs a name of its own", name));
    return name;
}

/// string.format(format, value at `index`)
std::string formatted(const Call& call, const std::string& format, int index) {
    lua_State* L = call.state();
    push_library(L);
    lua_getfield(L, -1, "string");
    lua_getfield(L, -1, "format");
    lua_pushlstring(L, format.data(), format.size());
    lua_pushvalue(L, index);
    lua_call(L, 2, 1);
    return lua_tostring(L, -1);
}

int report_value(Call& call) {
    call.at_most(3);
    auto& values = call.context().recorder.record().values;
    const std::string name = new_name(call, [&](const std::string& n) { return values.count(n) != 0; });
    RecordedValue value;
    if (call.type(2) == LUA_TNUMBER) {
        value.number = call.number(2, "value");
        value.text = call.given(3) ? formatted(call, call.text(3, "format"), 2) : number_text(*value.number);
    } else if (call.type(2) == LUA_TSTRING) {
        value.text = call.given(3) ? formatted(call, call.text(3, "format"), 2) : call.text(2, "value");
    } else {
        wrong_argument(call.state(), 2, "value", "number or text");
    }
    values[name] = std::move(value);
    return 0;
}

std::vector<std::string> read_cells(const Call& call, int row, lua_Integer number) {
    lua_State* L = call.state();
    if (lua_type(L, row) != LUA_TTABLE)
        throw InvalidArgument(
            fmt::format("row {} must be a table of cells, but {} was given", number, given_text(L, row)));
    std::vector<std::string> cells;
    for (lua_Integer i = 1; lua_rawgeti(L, row, i) != LUA_TNIL; lua_pop(L, 1), ++i)
        cells.push_back(lua_type(L, -1) == LUA_TNUMBER && !lua_isinteger(L, -1) ? number_text(lua_tonumber(L, -1))
                                                                                : value_text(L, -1));
    lua_pop(L, 1);
    return cells;
}

int report_table(Call& call) {
    call.at_most(2);
    auto& tables = call.context().recorder.record().tables;
    const std::string name = new_name(call, [&](const std::string& n) { return tables.count(n) != 0; });
    if (call.type(2) != LUA_TTABLE) wrong_argument(call.state(), 2, "rows", "list of rows, the first one the header");
    RecordedTable table;
    lua_State* L = call.state();
    for (lua_Integer i = 1; lua_rawgeti(L, 2, i) != LUA_TNIL; lua_pop(L, 1), ++i) {
        std::vector<std::string> cells = read_cells(call, lua_gettop(L), i);
        if (i == 1) table.header = cells;
        if (cells.size() != table.header.size())
            throw InvalidArgument(
                fmt::format("row {} has {} cells, but the header has {}", i, cells.size(), table.header.size()));
        if (i > 1) table.rows.push_back(std::move(cells));
    }
    if (table.header.empty()) throw InvalidArgument("the table has no header; its first row holds the column titles");
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
    return call.give(report_language_of(call.context()));
}

constexpr const char* kReportArea = "report";
constexpr std::array kReportFunctions = {
    FunctionEntry{"report.value", kReportArea, "report.value(name, x, format)", "puts a number or text into the report",
                  guarded<report_value>},
    FunctionEntry{"report.table", kReportArea, "report.table(name, {{title, ...}, {cell, ...}, ...})",
                  "puts a table into the report, header first", guarded<report_table>},
    FunctionEntry{"report.figure", kReportArea, "report.figure(name, fig, caption)", "puts a figure into the report",
                  guarded<report_figure>},
    FunctionEntry{"report.text", kReportArea, "report.text(name, markdown)", "puts Markdown text into the report",
                  guarded<report_text>},
    FunctionEntry{"report.language", kReportArea, "report.language() -> text", "tells the report's language",
                  guarded<report_language>},
};

}  // namespace

FunctionEntries report_functions() {
    return kReportFunctions;
}

}  // namespace dynlab::inline scripting
