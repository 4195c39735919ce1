#include "scripting/objects/text_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dynlab::inline scripting {
namespace {

constexpr Index kLongVector = 12, kShownEnds = 4, kShownRows = 12, kShownColumns = 8;
constexpr int kTableDepth = 3, kTableEntries = 20;

std::string plain_value_text(lua_State* L, int index, int depth, bool quoted);

bool whole_number_key(lua_State* L, int index, lua_Integer first, lua_Integer last) {
    return lua_isinteger(L, index) && lua_tointeger(L, index) >= first && lua_tointeger(L, index) <= last;
}

/// The named entries of a table, sorted, so that the text is the same in every run.
std::vector<std::string> named_entries(lua_State* L, int table, lua_Integer length, int depth) {
    std::vector<std::string> entries;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        if (!whole_number_key(L, -2, 1, length)) {
            const bool name = lua_type(L, -2) == LUA_TSTRING;
            const std::string key = name ? lua_tostring(L, -2) : "[" + plain_value_text(L, -2, depth, true) + "]";
            entries.push_back(key + " = " + plain_value_text(L, -1, depth, true));
        }
        lua_pop(L, 1);
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

std::string table_text(lua_State* L, int table, int depth) {
    if (depth >= kTableDepth) return "{...}";
    luaL_checkstack(L, 8, "table nested too deeply");
    std::vector<std::string> entries;
    const auto length = static_cast<lua_Integer>(lua_rawlen(L, table));
    for (lua_Integer i = 1; i <= length && i <= kTableEntries; ++i) {
        lua_rawgeti(L, table, i);
        entries.push_back(plain_value_text(L, -1, depth + 1, true));
        lua_pop(L, 1);
    }
    if (length > kTableEntries) entries.push_back(fmt::format("... ({} entries)", length));
    for (std::string& entry : named_entries(L, table, length, depth + 1)) entries.push_back(std::move(entry));
    return fmt::format("{{{}}}", fmt::join(entries, ", "));
}

std::string lua_number_text(lua_State* L, int index) {
    if (lua_isinteger(L, index)) return fmt::format("{}", lua_tointeger(L, index));
    return number_text(lua_tonumber(L, index), 14);
}

std::string plain_value_text(lua_State* L, int index, int depth, bool quoted) {
    index = lua_absindex(L, index);
    switch (lua_type(L, index)) {
        case LUA_TNUMBER:
            return lua_number_text(L, index);
        case LUA_TSTRING: {
            std::size_t length = 0;
            const char* text = lua_tolstring(L, index, &length);
            return quoted ? fmt::format("\"{}\"", std::string_view(text, length)) : std::string(text, length);
        }
        case LUA_TFUNCTION:
            return "function";
        case LUA_TTHREAD:
            return "coroutine";
        case LUA_TTABLE:
            if (luaL_getmetafield(L, index, "__tostring") == LUA_TNIL) return table_text(L, index, depth);
            lua_pop(L, 1);
            [[fallthrough]];
        default: {
            std::string text = luaL_tolstring(L, index, nullptr);
            lua_pop(L, 1);
            return text;
        }
    }
}

/// Numbers of one row padded to their columns.
std::string joined_row(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
    std::string row;
    for (std::size_t j = 0; j < cells.size(); ++j)
        row += fmt::format("{}{:>{}}", j == 0 ? "" : "  ", cells[j], widths[j]);
    return row;
}

}  // namespace

std::string vector_text(const VectorView& v) {
    std::string text = "[";
    const bool shortened = v.size() > kLongVector;
    for (Index i = 0; i < v.size(); ++i) {
        if (shortened && i == kShownEnds) {
            text += " ...";
            i = v.size() - kShownEnds;
        }
        text += (i == 0 ? "" : " ") + number_text(v[i]);
    }
    return text + (shortened ? fmt::format("] ({} values)", v.size()) : "]");
}

std::string matrix_text(const MatrixView& m) {
    const Index rows = std::min(m.rows(), kShownRows), columns = std::min(m.cols(), kShownColumns);
    std::vector<std::vector<std::string>> cells;
    std::vector<std::size_t> widths(static_cast<std::size_t>(columns), 0);
    for (Index i = 0; i < rows; ++i) {
        auto& row = cells.emplace_back();
        for (Index j = 0; j < columns; ++j) {
            row.push_back(number_text(m(i, j)));
            auto& width = widths[static_cast<std::size_t>(j)];
            width = std::max(width, row.back().size());
        }
    }
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : "\n") + joined_row(cells[i], widths);
    if (rows < m.rows() || columns < m.cols()) text += fmt::format("\n... ({} x {} matrix)", m.rows(), m.cols());
    if (m.size() == 0) return fmt::format("({} x {} matrix)", m.rows(), m.cols());
    return text;
}

std::string complex_text(const Complex& value, int significant_digits) {
    const std::string real = number_text(value.real(), significant_digits);
    if (value.imag() == 0) return real;
    return fmt::format("{} {} {}i", real, value.imag() < 0 ? "-" : "+",
                       number_text(std::abs(value.imag()), significant_digits));
}

std::string complex_vector_text(const ComplexVector& v) {
    std::string text = "[";
    const Index shown = std::min(v.size(), kLongVector);
    for (Index i = 0; i < shown; ++i) text += (i == 0 ? "" : ", ") + complex_text(v[i]);
    return text + (shown < v.size() ? fmt::format(", ...] ({} values)", v.size()) : "]");
}

std::string value_text(lua_State* L, int index) {
    return plain_value_text(L, index, 0, false);
}

}  // namespace dynlab::inline scripting
