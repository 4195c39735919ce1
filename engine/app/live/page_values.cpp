#include "app/live/page_values.h"

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "documents/html/plot_data.h"
#include "figures/figure.h"
#include "scripting/conversions/arguments.h"
#include "scripting/conversions/numeric.h"
#include "scripting/objects/figure_object.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/errors.h"

namespace dynlab::inline app {
namespace {

using nlohmann::json;

constexpr int kMaxDepth = 12;  // tables in tables; one that holds itself ends there

std::string json_text(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string number_json(double value) {
    return std::isfinite(value) ? json_text(value) : "null";
}

/// Adds an entry to the text of a list or an object that is not closed yet.
void add_entry(std::string& text, const std::string& entry) {
    if (text.size() > 1) text += ',';
    text += entry;
}

template <typename Values>
std::string list_json(const Values& values) {
    std::string list = "[";
    for (const double value : values) add_entry(list, number_json(value));
    return list + "]";
}

std::string matrix_json(NumericBlock& block) {
    std::string rows = "[";
    for (Index i = 0; i < block.rows; ++i) add_entry(rows, list_json(block.matrix().row(i)));
    return rows + "]";
}

std::string figure_json(ScriptFigure& shown, const Reader& reader) {
    shown.used = true;
    return plot_data(shown.figure, reader);
}

std::string value_json(lua_State* L, int index, int depth, const PageValues& page);

/// A list where the keys are 1, 2, ...; else an object of those that are texts.
std::string table_json(lua_State* L, int index, int depth, const PageValues& page) {
    const auto length = static_cast<lua_Integer>(lua_rawlen(L, index));
    if (depth > kMaxDepth) return "null";
    luaL_checkstack(L, 4, "tables in tables");
    std::map<std::string, std::string> members;  // in one order, so that equal tables have equal texts
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) continue;
        const std::string name = lua_tostring(L, -2);
        members[name] = name == "error" && lua_type(L, -1) == LUA_TSTRING
                            ? json_text(message_text(error_at(L, -1).with_place(), page.reader))
                            : value_json(L, lua_gettop(L), depth + 1, page);
    }
    if (!members.empty()) {
        std::string object = "{";
        for (const auto& [name, value] : members) add_entry(object, json_text(name) + ':' + value);
        return object + "}";
    }
    std::string list = "[";
    for (lua_Integer i = 1; i <= length; ++i) {
        lua_rawgeti(L, index, i);
        add_entry(list, value_json(L, lua_gettop(L), depth + 1, page));
        lua_pop(L, 1);
    }
    return list + "]";
}

std::string value_json(lua_State* L, int index, int depth, const PageValues& page) {
    switch (lua_type(L, index)) {
        case LUA_TBOOLEAN:
            return lua_toboolean(L, index) != 0 ? "true" : "false";
        case LUA_TNUMBER:
            return number_json(lua_tonumber(L, index));
        case LUA_TSTRING:
            return json_text(lua_tostring(L, index));
        case LUA_TTABLE:
            return table_json(L, index, depth, page);
        default:
            break;
    }
    if (NumericBlock* const block = to_vector(L, index)) return list_json(block->vector());
    if (NumericBlock* const block = to_matrix(L, index)) return matrix_json(*block);
    if (FigurePointer* const figure = to_object<FigurePointer>(L, index)) return figure_json(**figure, page.reader);
    return "null";
}

int show(Call& call) {
    PageValues& page = call.owner<PageValues>();
    page.show(call.text(1, "name"), value_json(call.state(), 2, 0, page));
    return 0;
}

/// The labels of the figures that the page's views draw themselves.
Message label_called(const std::string& name) {
    if (name == "time") return axis_label(Message("time"), "s");
    if (name == "delay") return axis_label(Message("delay"), "s");
    if (name == "frequency") return axis_label(Message("frequency"), "rad/s");
    if (name == "power") return Message("power of the output");
    if (name == "mean_square_error") return Message("mean square error");
    if (name == "measured") return Message("measured");
    if (name == "by_hand") return Message("by hand");
    if (name == "final_level") return Message("final level");
    if (name == "first_peak") return Message("first peak");
    throw InvalidArgument("unknown label \"{}\"", name);
}

int give_label(Call& call) {
    return call.give(message_text(label_called(call.text(1, "name")), call.owner<PageValues>().reader));
}

constexpr std::array kPageFunctions = {
    FunctionEntry{"workbench.show", "workbench", "workbench.show(name, value)", "gives the page a value",
                  guarded<show>},
    FunctionEntry{"workbench.label", "workbench", "workbench.label(name) -> text", "text for a figure of the page",
                  guarded<give_label>},
};

}  // namespace

FunctionEntries page_functions() {
    return kPageFunctions;
}

}  // namespace dynlab::inline app
