#pragma once
#include <lua.hpp>
#include <string>
#include <vector>

namespace dynlab::inline scripting {

/// The variables of the prompt. Every statement is a separate chunk, so a `local` of one statement would be gone in the
/// next. Names declared as local are therefore kept in a table that Lua searches before the globals; all statements
/// (and their functions) share it. Like a local, such a name may be that of one of dynlab's functions. All other names
/// are globals as in any script.

/// Makes that table, empty. Call once, after the library was sealed.
void make_prompt_variables(lua_State* L);
/// Pushes it, nil when there is none: the environment (_ENV) of a statement, to be read raw by the completion.
void push_prompt_variables(lua_State* L);

/// The next statement declares these names. Until it assigns to one, the name means what it meant before.
void announce_variables(lua_State* L, const std::vector<std::string>& names);
/// Ends the statement: names that it did not assign are not declared.
void clear_unassigned(lua_State* L, const std::vector<std::string>& names);

}  // namespace dynlab::inline scripting
