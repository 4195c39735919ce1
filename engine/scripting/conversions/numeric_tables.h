#pragma once
#include <lua.hpp>
#include <string>

namespace dynlab::inline scripting {

/// Replaces a table of numbers at stack index `index` by a vector; entries may also be vectors, which are joined.
/// `label` names the table in messages.
void make_vector_of_table(lua_State* L, int index, const std::string& label);

/// Replaces a table at `index` by a matrix: plain tables of numbers are its rows, vectors its columns.
void make_matrix_of_table(lua_State* L, int index, const std::string& label);

}  // namespace dynlab::inline scripting
