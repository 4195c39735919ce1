#pragma once
#include <lua.hpp>

namespace dynlab::inline scripting {

/// Replacements for functions of string and table that could loop in C forever or fill the memory, print, tostring,
/// pairs in a repeatable order, math.random from the run's stream. Expects the table of functions on top.
void add_restricted_functions(lua_State* L);

}  // namespace dynlab::inline scripting
