#include "scripting/conversions/numeric_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "numerics/error.h"
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {
namespace {

/// Numbers that the entry on top of the stack stands for: one, or a vector's; -1 for anything else.
Index entry_size(lua_State* L) {
    if (lua_type(L, -1) == LUA_TNUMBER) return 1;
    const NumericBlock* block = to_vector(L, -1);
    return block == nullptr ? -1 : block->rows;
}

Index joined_size(lua_State* L, int index, Index entries, const std::string& label) {
    Index total = 0;
    for (Index i = 1; i <= entries; ++i) {
        lua_rawgeti(L, index, i);
        const Index size = entry_size(L);
        if (size < 0)
            throw InvalidArgument(
                fmt::format("{} must be a vector of numbers, but its element {} is {}", label, i, given_text(L, -1)));
        total += size;
        lua_pop(L, 1);
    }
    return total;
}

/// What a table is that has no numbered entries: empty, or a record of variables, say.
std::string without_entries(lua_State* L, int index) {
    std::vector<std::string> names;
    lua_pushnil(L);
    while (lua_next(L, index)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -1));
    }
    if (names.empty()) return "the table is empty";
    std::sort(names.begin(), names.end());
    return fmt::format("the table holds {}: give one of these, such as data.{}", fmt::join(names, ", "), names.front());
}

/// Checks that entry `i` on top has the length of the first.
void check_length(Index length, Index first_length, Index i, const char* kind, const std::string& label) {
    if (length != first_length)
        throw InvalidArgument(
            fmt::format("{}: {} {} has {} values, but {} 1 has {}", label, kind, i, length, kind, first_length));
}

}  // namespace

void make_vector_of_table(lua_State* L, int index, const std::string& label) {
    index = lua_absindex(L, index);
    const auto entries = static_cast<Index>(lua_rawlen(L, index));
    const Index total = joined_size(L, index, entries, label);
    double* target = push_vector(L, total).data();
    for (Index i = 1; i <= entries; ++i) {
        if (lua_rawgeti(L, index, i) == LUA_TNUMBER) {
            *target++ = lua_tonumber(L, -1);
        } else {
            NumericBlock* part = to_vector(L, -1);
            target = std::copy_n(part->data(), part->rows, target);
        }
        lua_pop(L, 1);
    }
    lua_replace(L, index);
}

void make_matrix_of_table(lua_State* L, int index, const std::string& label) {
    index = lua_absindex(L, index);
    const auto entries = static_cast<Index>(lua_rawlen(L, index));
    if (entries == 0) throw InvalidArgument(label + " must have rows or columns, but " + without_entries(L, index));
    const bool by_rows = lua_rawgeti(L, index, 1) == LUA_TTABLE;
    const char* kind = by_rows ? "row" : "column";
    const Index length = by_rows ? static_cast<Index>(lua_rawlen(L, -1)) : entry_size(L);
    if (length < 0 || lua_isnumber(L, -1))
        throw InvalidArgument(fmt::format(
            "{} must be a list of rows {{{{1, 2}}, {{3, 4}}}} or of vectors (its columns), but its entry 1 is {}",
            label, given_text(L, -1)));
    lua_pop(L, 1);
    NumericBlock& block = by_rows ? push_matrix(L, entries, length) : push_matrix(L, length, entries);
    for (Index i = 0; i < entries; ++i) {
        const std::string entry = fmt::format("{}, {} {}", label, kind, i + 1);
        if ((lua_rawgeti(L, index, i + 1) == LUA_TTABLE) != by_rows || (!by_rows && to_vector(L, -1) == nullptr))
            throw InvalidArgument(
                fmt::format("{} must be a {} like the first, but it is {}", entry, kind, given_text(L, -1)));
        if (by_rows) make_vector_of_table(L, -1, entry);
        NumericBlock* part = to_vector(L, -1);
        check_length(part->rows, length, i + 1, kind, label);
        if (by_rows) {
            block.matrix().row(i) = part->vector().transpose();
        } else {
            block.matrix().col(i) = part->vector();
        }
        lua_pop(L, 1);
    }
    lua_replace(L, index);
}

}  // namespace dynlab::inline scripting
