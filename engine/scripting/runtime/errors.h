#pragma once
#include <lua.hpp>
#include <string>
#include <vector>

namespace dynlab::inline scripting {

struct RuntimeContext;

/// "a model", "an iddata".
std::string article(const std::string& noun);
/// A line of a text, counted from 1; empty where it has none.
std::string line_of(const std::string& source, int line);

/// Message handler: turns Lua's own runtime messages on top of the stack into plain sentences; other values stay.
int translate_error(lua_State* L);
void translate_value_on_top(lua_State* L);
/// The sentence about the memory limit, with the line of the script where it was reached.
std::string memory_message(const RuntimeContext& context);
/// Replaces the error on top by it.
void push_memory_message(lua_State* L);

/// About a name that nobody defined, in this line of a script (empty where it is not known); `names` are those there
/// are.
std::string unknown_name_sentence(const std::string& name, const std::string& line, std::vector<std::string> names);
/// About a function of dynlab that a script gives another value.
std::string replaced_name_sentence(const std::string& name);
/// About a member that a table of dynlab lacks; `of_library`: a function by itself is called so.
std::string unknown_member_sentence(const std::string& table, const std::string& key, bool of_library,
                                    std::vector<std::string> names);

/// "file:line: text" taken apart; line 0 and empty file when the text has no location.
struct LocatedMessage {
    std::string file;
    int line = 0;
    std::string text;
    std::string joined() const;
};
LocatedMessage take_apart(const std::string& message);

/// Plain words for a syntax error of `source`, with a hint when the line looks like MATLAB.
std::string plain_syntax_message(const std::string& message, const std::string& source);

}  // namespace dynlab::inline scripting
