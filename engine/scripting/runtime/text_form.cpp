#include "scripting/runtime/text_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/languages.h"
#include "scripting/runtime/context.h"

namespace dynlab::inline scripting {
namespace {

constexpr Index kLongVector = 12, kShownEnds = 4, kShownRows = 12, kShownColumns = 8;
constexpr int kTableDepth = 3, kTableEntries = 20;
constexpr std::size_t kLineWidth = 80, kShortEntry = 24;

/// How values become text: whole on one line, or for reading.
struct TextStyle {
    int digits;        ///< of numbers that are not whole
    bool broken_down;  ///< tables that one line does not hold go over several
};
constexpr TextStyle kWhole{14, false}, kForReading{7, true};

std::string plain_value_text(lua_State* L, int index, int depth, bool quoted, TextStyle style);

bool whole_number_key(lua_State* L, int index, lua_Integer first, lua_Integer last) {
    return lua_isinteger(L, index) && lua_tointeger(L, index) >= first && lua_tointeger(L, index) <= last;
}

/// A value of several lines goes below its name.
std::string named_entry(const std::string& key, const std::string& value, TextStyle style) {
    const bool below = style.broken_down && !value.starts_with("{") && value.find('\n') != std::string::npos;
    return key + (below ? " =\n" : " = ") + value;
}

/// The named entries of a table, sorted, so that the text is the same in every run.
std::vector<std::string> named_entries(lua_State* L, int table, lua_Integer length, int depth, TextStyle style) {
    std::vector<std::string> entries;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        if (!whole_number_key(L, -2, 1, length)) {
            const bool name = lua_type(L, -2) == LUA_TSTRING;
            const std::string key =
                name ? lua_tostring(L, -2) : "[" + plain_value_text(L, -2, depth, true, style) + "]";
            entries.push_back(named_entry(key, plain_value_text(L, -1, depth, true, style), style));
        }
        lua_pop(L, 1);
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

/// Short entries fill lines; each of the others gets a separate line.
std::string in_lines(const std::vector<std::string>& entries, std::size_t in_list) {
    std::string text = "{\n", line;
    const auto end_line = [&] {
        std::string indented = "  ";
        for (const char c : line) indented += c == '\n' ? std::string("\n  ") : std::string(1, c);
        if (!line.empty()) text += indented + "\n";
        line.clear();
    };
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string entry = entries[i] + (i + 1 < entries.size() ? "," : "");
        const bool joins = i < in_list && entry.size() <= kShortEntry && entry.find('\n') == std::string::npos;
        if (!joins || line.size() + entry.size() + 3 > kLineWidth) end_line();
        line += (line.empty() ? "" : " ") + entry;
        if (!joins) end_line();
    }
    end_line();
    return text + "}";
}

std::string table_text(lua_State* L, int table, int depth, TextStyle style) {
    if (depth >= kTableDepth) return "{...}";
    luaL_checkstack(L, 8, "table nested too deeply");
    std::vector<std::string> entries;
    const auto length = static_cast<lua_Integer>(lua_rawlen(L, table));
    for (lua_Integer i = 1; i <= length && i <= kTableEntries; ++i) {
        lua_rawgeti(L, table, i);
        entries.push_back(plain_value_text(L, -1, depth + 1, true, style));
        lua_pop(L, 1);
    }
    if (length > kTableEntries)
        entries.push_back("... " + message_text(Message::plural(length, "({} entry)", "({} entries)"),
                                                {catalog_of(context_of(L).services.language_code())}));
    const std::size_t in_list = entries.size();
    for (std::string& entry : named_entries(L, table, length, depth + 1, style)) entries.push_back(std::move(entry));
    const std::string line = fmt::format("{{{}}}", fmt::join(entries, ", "));
    const bool fits = line.size() <= kLineWidth && line.find('\n') == std::string::npos;
    return fits || !style.broken_down ? line : in_lines(entries, in_list);
}

std::string lua_number_text(lua_State* L, int index, TextStyle style) {
    if (lua_isinteger(L, index)) return fmt::format("{}", lua_tointeger(L, index));
    const double number = lua_tonumber(L, index);
    return number_text(number, number == std::round(number) ? kWhole.digits : style.digits);
}

std::string plain_value_text(lua_State* L, int index, int depth, bool quoted, TextStyle style) {
    index = lua_absindex(L, index);
    switch (lua_type(L, index)) {
        case LUA_TNUMBER:
            return lua_number_text(L, index, style);
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
            if (luaL_getmetafield(L, index, "__tostring") == LUA_TNIL) return table_text(L, index, depth, style);
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

std::string size_text(Index size, const Reader& reader) {
    return message_text(Message::plural(size, "({} value)", "({} values)"), reader);
}

}  // namespace

std::string vector_text(const VectorView& v, const Reader& reader) {
    std::string text = "[";
    const bool shortened = v.size() > kLongVector;
    for (Index i = 0; i < v.size(); ++i) {
        if (shortened && i == kShownEnds) {
            text += " ...";
            i = v.size() - kShownEnds;
        }
        text += (i == 0 ? "" : " ") + number_text(v[i]);
    }
    return text + (shortened ? "] " + size_text(v.size(), reader) : "]");
}

std::string matrix_text(const MatrixView& m, const Reader& reader) {
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
    if (m.size() > 0 && rows == m.rows() && columns == m.cols()) return text;
    return (m.size() == 0 ? "" : text + "\n... ") +
           message_text(Message("({} x {} matrix)", m.rows(), m.cols()), reader);
}

std::string complex_text(const Complex& value, const Reader& reader, int significant_digits) {
    const auto number = [&](double part) { return number_text(significant(part, significant_digits), reader); };
    if (value.imag() == 0) return number(value.real());
    return fmt::format("{} {} {}i", number(value.real()), value.imag() < 0 ? "-" : "+", number(std::abs(value.imag())));
}

std::string complex_vector_text(const ComplexVector& v, const Reader& reader) {
    std::string text = "[";
    const Index shown = std::min(v.size(), kLongVector);
    for (Index i = 0; i < shown; ++i) text += (i == 0 ? "" : ", ") + complex_text(v[i]);
    return text + (shown < v.size() ? ", ...] " + size_text(v.size(), reader) : "]");
}

std::string value_text(lua_State* L, int index) {
    return plain_value_text(L, index, 0, false, kWhole);
}

std::string text_for_reading(lua_State* L, int index) {
    return plain_value_text(L, index, 0, false, kForReading);
}

}  // namespace dynlab::inline scripting
