#include "scripting/conversions/variable_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "documents/text_lines.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/value_members.h"
#include "scripting/runtime/prompt_variables.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

std::string in_brackets(const std::string& polynomial) {
    return polynomial.find(' ') == std::string::npos ? polynomial : "(" + polynomial + ")";
}

/// What a list has room for of a value's text: a fraction's three lines as one, "1/(s^2 + s + 1)", else the first line.
std::string first_words(const std::string& text) {
    const std::vector<std::string> lines = lines_of(text);
    if (lines.size() < 3) return lines.empty() ? "" : lines.front();
    const std::string above = trimmed(lines[0]), below = trimmed(lines[2]);
    const std::size_t width = std::max(above.size(), below.size());
    // The longer line is directly above or below the bar; a delay may precede the bar.
    const std::size_t bar = (above.size() == width ? lines[0] : lines[2]).find_first_not_of(' ');
    if (width == 0 || bar >= lines[1].size() || lines[1].substr(bar, width) != std::string(width, '-'))
        return lines.front();
    const std::string time = trimmed(lines[1].substr(bar + width));
    return lines[1].substr(0, bar) + in_brackets(above) + (below == "1" ? "" : "/" + in_brackets(below)) +
           (time.empty() ? "" : ", " + time);
}

/// Of the vector, the matrix' first column or the data's output on top.
void describe_signal(lua_State* L, const std::string& name, ListedVariable& variable) {
    constexpr Index kPoints = 64;
    NumericBlock* block = to_vector(L, -1);
    if (block == nullptr) block = to_matrix(L, -1);
    const int top = lua_gettop(L);
    if (block == nullptr && variable.kind == "iddata" && push_value_of(L, {name, "y"})) {
        block = to_vector(L, -1);
        if (block == nullptr) block = to_matrix(L, -1);
    }
    if (block != nullptr) {
        if (variable.size.empty()) variable.size = fmt::format("{} x {}", block->rows, block->columns);
        const Index count = std::min(block->rows, kPoints);
        for (Index i = 0; i < count; ++i) {
            const double value = block->matrix()(count == 1 ? 0 : i * (block->rows - 1) / (count - 1), 0);
            if (std::isfinite(value)) variable.curve.push_back(value);
        }
    }
    lua_settop(L, top);
}

ListedVariable described_variable(lua_State* L, const std::string& name) {
    constexpr std::size_t kMaxLength = 60;
    ListedVariable variable{name, object_name(L, -1), {}, {}, {}};
    if (variable.kind.empty()) variable.kind = luaL_typename(L, -1);
    if (lua_istable(L, -1) && lua_rawlen(L, -1) > 0) variable.size = fmt::format("{}", lua_rawlen(L, -1));
    describe_signal(L, name, variable);
    variable.text = first_words(value_text(L, -1));
    if (variable.text.size() > kMaxLength) variable.text = variable.text.substr(0, kMaxLength) + " ...";
    return variable;
}

/// Variables of the table on top, by name.
void add_variables(lua_State* L, std::map<std::string, ListedVariable>& variables) {
    const int table = lua_absindex(L, -1);
    lua_pushnil(L);
    while (lua_next(L, table)) {
        if (lua_type(L, -2) == LUA_TSTRING) {
            const std::string name = lua_tostring(L, -2);
            variables[name] = described_variable(L, name);
        }
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

}  // namespace

std::vector<ListedVariable> variable_list(lua_State* L) {
    std::map<std::string, ListedVariable> variables;
    lua_pushglobaltable(L);
    add_variables(L, variables);
    push_prompt_variables(L);
    if (lua_istable(L, -1))
        add_variables(L, variables);
    else
        lua_pop(L, 1);
    std::vector<ListedVariable> list;
    for (auto& [name, variable] : variables) list.push_back(std::move(variable));
    return list;
}

}  // namespace dynlab::inline scripting
