#pragma once
#include <lua.hpp>
#include <string>
#include <vector>

namespace dynlab::inline scripting {

/// Fills the fresh state `L` with the safe part of Lua's libraries: base without chunk loading, string, table, math,
/// utf8, coroutine. Leaves the table of all functions, not yet reachable for scripts, on the stack.
void open_safe_libraries(lua_State* L);

/// Takes the table of functions (top of the stack, popped) and makes it what scripts see: globals fall back on it, the
/// table `dynlab` shows it, its tables cannot be changed, unknown names are errors with a suggestion.
void seal_library(lua_State* L);

/// Registry key of the table of functions, for adding to it after it was sealed.
void push_library(lua_State* L);

/// pcall, xpcall, coroutine.resume, wrap and close that let a stop (Ctrl-C, limit of time) through and translate
/// messages. Expects the table of functions on top.
void add_protected_calls(lua_State* L);

/// Sets field `name` of the table on top to a C function.
void set_function(lua_State* L, const char* name, lua_CFunction function);

/// Adds the texts among the keys of the table at the index, in no order.
void collect_text_keys(lua_State* L, int table, std::vector<std::string>& names);

}  // namespace dynlab::inline scripting
