#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/languages.h"
#include "base/reader.h"
#include "platform/spelling.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/matlab_hints.h"
#include "scripting/runtime/prompt_variables.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

char library_key;  // its address is the registry key

/// The activation of the innermost line of a script.
bool script_caller(lua_State* L, lua_Debug& caller) {
    for (int level = 1; lua_getstack(L, level, &caller); ++level) {
        lua_getinfo(L, "l", &caller);
        if (caller.currentline > 0) return true;
    }
    return false;
}

/// Names of the local variables that the calling script line sees, those of the prompt too.
void collect_locals(lua_State* L, std::vector<std::string>& names) {
    push_prompt_variables(L);
    if (lua_istable(L, -1)) collect_text_keys(L, -1, names);
    lua_pop(L, 1);
    lua_Debug caller;
    if (!script_caller(L, caller)) return;
    for (int i = 1; const char* name = lua_getlocal(L, &caller, i); ++i) {
        lua_pop(L, 1);
        if (name[0] != '(') names.emplace_back(name);
    }
}

std::optional<std::string> nearest(const std::string& word, std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return nearest_word(word, names);
}

std::string key_text(lua_State* L, int index) {
    if (lua_type(L, index) == LUA_TSTRING) return lua_tostring(L, index);
    return luaL_typename(L, index);
}

/// Pushes the function that the script calls by an earlier name, and prints its present name once per run.
void push_renamed(lua_State* L, const std::string& earlier) {
    RuntimeContext& context = context_of(L);
    push_library(L);
    lua_pushstring(L, std::string(present_name(earlier)).c_str());
    lua_rawget(L, -2);
    if (context.renamed_reported.insert(earlier).second)
        print_text(L, message_text(renamed(earlier), {catalog_of(context.services.language_code())}) + "\n");
}

/// __index of the table of functions: the script read an undefined name.
int unknown_global(lua_State* L) {
    Message message;
    {
        const std::string name = key_text(L, 2);
        if (!present_name(name).empty()) return push_renamed(L, name), 1;
        RuntimeContext& context = context_of(L);
        const ScriptPlace here = script_place(L);
        const bool of_script = here.file == context.script_name;
        std::vector<std::string> names;
        push_library(L);
        collect_text_keys(L, -1, names);
        lua_pushglobaltable(L);
        collect_text_keys(L, -1, names);
        collect_locals(L, names);
        message = unknown_name(name, of_script ? line_of(context.source, here.line) : "", std::move(names));
    }
    raise_error(L, message);
}

/// __newindex of the globals: a name that is not a variable yet.
int set_global(lua_State* L) {
    push_library(L);
    lua_pushvalue(L, 2);
    if (lua_rawget(L, -2) != LUA_TNIL) raise_error(L, replaced_name(key_text(L, 2)));
    lua_settop(L, 3);
    lua_rawset(L, 1);
    return 0;
}

/// __index behind a sealed table; upvalue 1 is the table's name.
int refuse_unknown_member(lua_State* L) {
    Message message;
    {
        std::vector<std::string> names;
        collect_text_keys(L, 1, names);
        const std::string key = key_text(L, 2);
        push_library(L);
        lua_pushstring(L, key.c_str());
        const bool of_library = lua_rawget(L, -2) == LUA_TFUNCTION;
        message = unknown_member(lua_tostring(L, lua_upvalueindex(1)), key, of_library, std::move(names));
    }
    raise_error(L, message);
}

int refuse_change(lua_State* L) {
    const std::string table = lua_tostring(L, lua_upvalueindex(1));
    raise_error(
        L,
        Message("'{}' is a built-in table and cannot be changed; store values and functions in your own table", table));
}

/// __pairs of a sealed table: walks a copy of what it shows.
int pairs_of_sealed(lua_State* L) {
    lua_getglobal(L, "pairs");
    lua_newtable(L);
    lua_pushnil(L);
    while (lua_next(L, lua_upvalueindex(1))) {
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, -4);
    }
    lua_call(L, 1, 3);
    return 3;
}

/// Replaces the table on top by an empty one that shows it and refuses changes.
void push_sealed(lua_State* L, const char* name) {
    const int shown = lua_absindex(L, -1);
    lua_newtable(L);
    lua_createtable(L, 0, 5);
    lua_pushvalue(L, shown);
    lua_setfield(L, -2, "__index");
    lua_pushstring(L, name);
    lua_pushcclosure(L, refuse_change, 1);
    lua_setfield(L, -2, "__newindex");
    lua_pushvalue(L, shown);
    lua_pushcclosure(L, pairs_of_sealed, 1);
    lua_setfield(L, -2, "__pairs");
    lua_pushstring(L, name);
    lua_setfield(L, -2, "__name");
    lua_pushstring(L, name);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_replace(L, shown);
}

/// Gives the table on top a metatable whose __index reports unknown members.
void report_unknown_members(lua_State* L, const char* name) {
    lua_createtable(L, 0, 1);
    lua_pushstring(L, name);
    lua_pushcclosure(L, refuse_unknown_member, 1);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
}

void seal_tables_of_library(lua_State* L) {
    const int library = lua_absindex(L, -1);
    std::vector<std::string> names;
    collect_text_keys(L, library, names);
    for (const std::string& name : names) {
        if (lua_getfield(L, library, name.c_str()) != LUA_TTABLE || lua_getmetatable(L, -1)) {
            lua_settop(L, library);
            continue;
        }
        report_unknown_members(L, name.c_str());
        push_sealed(L, name.c_str());
        lua_setfield(L, library, name.c_str());
    }
}

}  // namespace

void collect_text_keys(lua_State* L, int table, std::vector<std::string>& names) {
    table = lua_absindex(L, table);
    lua_pushnil(L);
    while (lua_next(L, table)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -1));
    }
}

Message unknown_name(const std::string& name, const std::string& line, std::vector<std::string> names) {
    if (const Message comment = comment_hint(line, name); !comment.empty())
        return Message("unknown variable '{}'; {}", name, comment);
    if (const Message string = string_prefix_hint(line, name); !string.empty())
        return Message("unknown function '{}'; {}", name, string);
    if (const Message* const matlab = matlab_name_hint(name))
        return Message("unknown function or variable '{}'; {}", name, *matlab);
    const auto near = nearest(name, std::move(names));
    return near ? Message("unknown function or variable '{}'; did you mean '{}'?", name, *near)
                : Message("unknown function or variable '{}'", name);
}

Message replaced_name(const std::string& name) {
    return Message(
        "'{}' is a function or table of dynlab and cannot be replaced; choose another name, or write 'local {} = ...' "
        "to define a variable with this name",
        name, name);
}

Message unknown_member(const std::string& table, const std::string& key, bool of_library,
                       std::vector<std::string> names) {
    if (key == "randomseed") return Message("to set the seed of random numbers, write rng(seed)");
    if (of_library) return Message("'{}' has no member '{}'; write {}(x), without {}", table, key, key, table);
    const auto near = nearest(key, std::move(names));
    return near ? Message("'{}' has no member '{}'; did you mean '{}'?", table, key, *near)
                : Message("'{}' has no member '{}'", table, key);
}

void push_library(lua_State* L) {
    lua_rawgetp(L, LUA_REGISTRYINDEX, &library_key);
}

void set_function(lua_State* L, const char* name, lua_CFunction function) {
    lua_pushcfunction(L, function);
    lua_setfield(L, -2, name);
}

void seal_library(lua_State* L) {
    const int library = lua_absindex(L, -1);
    seal_tables_of_library(L);
    lua_pushvalue(L, library);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &library_key);

    lua_createtable(L, 0, 1);
    set_function(L, "__index", unknown_global);
    lua_setmetatable(L, library);

    lua_pushvalue(L, library);
    push_sealed(L, "dynlab");
    lua_setfield(L, library, "dynlab");

    lua_newtable(L);  // the script's own globals
    lua_createtable(L, 0, 3);
    lua_pushvalue(L, library);
    lua_setfield(L, -2, "__index");
    set_function(L, "__newindex", set_global);
    lua_pushliteral(L, "globals");
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_pushvalue(L, -1);
    lua_setfield(L, library, "_G");
    lua_rawseti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
    lua_settop(L, library - 1);
}

}  // namespace dynlab::inline scripting
