#pragma once
#include <lua.hpp>
#include <string>
#include <vector>

#include "scripting/runtime/placed_message.h"

namespace dynlab::inline scripting {

struct RuntimeContext;

/// A line of a text, counted from 1; empty where it has none.
std::string line_of(const std::string& source, int line);

/// Message handler: turns Lua's own runtime messages on top of the stack into plain sentences; other values stay.
int translate_error(lua_State* L);
void translate_value_on_top(lua_State* L);
/// The sentence about the memory limit, with the line of the script where it was reached.
PlacedMessage memory_error(const RuntimeContext& context);
/// Replaces the error on top by it.
void push_memory_error(lua_State* L);

/// What the error value at a stack index says. Lua has the English text of it alone: the message is that of the error
/// which was raised last, if this is its text, and else this text, verbatim.
PlacedMessage error_at(lua_State* L, int index);

/// The message about an undefined name in this line of a script (empty if the line is unknown); `names` are the defined
/// names.
Message unknown_name(const std::string& name, const std::string& line, std::vector<std::string> names);
/// About a function of dynlab that a script gives another value.
Message replaced_name(const std::string& name);
/// The message about a member that a table of dynlab lacks; `of_library`: the functions are also called without the
/// table.
Message unknown_member(const std::string& table, const std::string& key, bool of_library,
                       std::vector<std::string> names);

/// "file:line: text" taken apart; line 0 and empty file when the text has no location.
struct LocatedMessage {
    std::string file;
    int line = 0;
    std::string text;
};
LocatedMessage take_apart(const std::string& message);

/// Plain words for a syntax error of `source`, with a hint when the line looks like MATLAB.
PlacedMessage syntax_error(const std::string& message, const std::string& source);

}  // namespace dynlab::inline scripting
