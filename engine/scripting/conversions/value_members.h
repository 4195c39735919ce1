#pragma once
#include <lua.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline scripting {

enum class MemberKind { kField, kMethod };

/// Pushes the value that the chain of names ("data", "y") leads to and returns true; pushes nothing and returns false
/// when a link is missing. No function of a script is called: tables are read raw along their __index tables, objects
/// of dynlab by their own fields. May raise a Lua error (memory): call protected.
bool push_value_of(lua_State* L, const std::vector<std::string_view>& chain);

/// Names after a dot (fields; for tables all names) or a colon (methods) of the value on top.
std::vector<std::string> member_names(lua_State* L, MemberKind kind);

/// Names of all variables and functions that a statement of the prompt sees.
std::vector<std::string> visible_names(lua_State* L);

}  // namespace dynlab::inline scripting
