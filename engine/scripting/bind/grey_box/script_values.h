#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scripting/arguments/script_function.h"

namespace dynlab::inline scripting {

using Names = std::vector<std::string>;

// ---- arguments of the functions

void push_numbers(lua_State* L, const char* kind, const char* table, const Names& names, const Vector& values);
/// One number, or a table where there are several or the function wrote u[1].
void push_inputs(lua_State* L, const Vector& u, bool indexed);

// ---- results of the functions

/// The function's name in messages, and what it gives.
struct RequestedValues {
    const char* function;
    const Message* what;  ///< read where there is a count
    Index count;          ///< -1 for any
};

/// One number, or a vector of one value, on top of the stack.
std::optional<double> number_at_top(lua_State* L);

/// What a function returned, element by element: `read()` takes the value on top of the stack, or refuses it. Pops it.
template <class Value, class Read>
std::vector<Value> read_list(lua_State* L, const RequestedValues& requested, const Read& read) {
    std::vector<Value> values;
    const int top = lua_gettop(L);
    const auto refuse = [&](Index place) {
        if (place == 0)
            throw InvalidArgument("{} must return a table of numbers, but it returned {}", requested.function,
                                  given_value(L, -1));
        throw InvalidArgument("{} must return a table of numbers, but its element {} is {}", requested.function, place,
                              given_value(L, -1));
    };
    if (NumericBlock* block = to_vector(L, top); block != nullptr && block->rows != 1) {
        for (Index i = 0; i < block->rows; ++i) {
            lua_pushnumber(L, block->data()[i]);
            values.push_back(*read());
            lua_pop(L, 1);
        }
    } else if (lua_istable(L, top)) {
        for (lua_Integer i = 1; lua_rawgeti(L, top, i) != LUA_TNIL; ++i) {
            const auto value = read();
            if (!value) refuse(i);
            values.push_back(*value);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    } else if (const auto value = read()) {
        values.push_back(*value);
    } else {
        refuse(0);
    }
    if (requested.count >= 0 && static_cast<Index>(values.size()) != requested.count)
        throw InvalidArgument("{} must return {}, but it returned {}", requested.function, *requested.what,
                              plural(values.size(), "{} value", "{} values"));
    lua_settop(L, top - 1);
    return values;
}

Vector numbers_on_top(lua_State* L, const RequestedValues& requested);

// ---- matrices of a function of p

/// A matrix that is read entry by entry: a table of rows, a matrix, or a number.
template <class Value>
struct Entries {
    Index rows = 0, columns = 0;
    std::vector<Value> values;  ///< row by row
};

template <class Value, class Read>
Entries<Value> read_matrix(lua_State* L, int index, const char* name, const Read& read) {
    Entries<Value> entries;
    const auto refuse = [&] {
        throw InvalidArgument("the matrix {} must be {}, but {} was given", name,
                              Message("a table of rows such as {{a, b}, {c, d}}"), given_value(L, -1));
    };
    const auto add = [&] {
        const auto value = read();
        if (!value) refuse();
        entries.values.push_back(*value);
        lua_pop(L, 1);
    };
    NumericBlock* block = to_matrix(L, index) != nullptr ? to_matrix(L, index) : to_vector(L, index);
    if (block != nullptr) {
        entries.rows = block->rows;
        entries.columns = block->columns;
        for (Index i = 0; i < block->rows; ++i)
            for (Index j = 0; j < block->columns; ++j) lua_pushnumber(L, block->matrix()(i, j)), add();
        return entries;
    }
    if (!lua_istable(L, index)) {
        lua_pushvalue(L, index);
        add();
        entries.rows = entries.columns = 1;
        return entries;
    }
    for (lua_Integer i = 1; lua_rawgeti(L, index, i) != LUA_TNIL; ++i, ++entries.rows) {
        const int row = lua_gettop(L);
        if (!lua_istable(L, row)) {  // a column of single values
            add();
            entries.columns = 1;
            continue;
        }
        Index columns = 0;
        for (lua_Integer j = 1; lua_rawgeti(L, row, j) != LUA_TNIL; ++j, ++columns) add();
        if (i > 1 && columns != entries.columns)
            throw InvalidArgument("the rows of the matrix {} must have the same length, but have {} and {} elements",
                                  name, entries.columns, columns);
        entries.columns = columns;
        lua_settop(L, row - 1);
    }
    lua_settop(L, lua_gettop(L) - 1);
    return entries;
}

}  // namespace dynlab::inline scripting
