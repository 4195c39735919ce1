#include "scripting/runtime/sandbox.h"

#include <array>

namespace dynlab::inline scripting {
namespace {

struct SafeLibrary {
    const char* name;
    lua_CFunction open;
};

constexpr std::array kSafeLibraries = {SafeLibrary{"string", luaopen_string}, SafeLibrary{"table", luaopen_table},
                                       SafeLibrary{"math", luaopen_math}, SafeLibrary{"utf8", luaopen_utf8},
                                       SafeLibrary{"coroutine", luaopen_coroutine}};

constexpr std::array kSafeBase = {"assert", "error",  "getmetatable", "next",     "rawequal", "rawget",
                                  "rawlen", "rawset", "select",       "tonumber", "type",     "_VERSION"};

void remove_field(lua_State* L, const char* table, const char* field) {
    lua_getfield(L, -1, table);
    lua_pushnil(L);
    lua_setfield(L, -2, field);
    lua_pop(L, 1);
}

/// No script can reach the table of string functions through ("").
void lock_string_metatable(lua_State* L) {
    lua_pushliteral(L, "");
    if (lua_getmetatable(L, -1)) {
        lua_pushliteral(L, "string");
        lua_setfield(L, -2, "__metatable");
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

}  // namespace

void open_safe_libraries(lua_State* L) {
    lua_createtable(L, 0, 160);
    luaL_requiref(L, "_G", luaopen_base, 0);
    for (const char* name : kSafeBase) {
        lua_getfield(L, -1, name);
        lua_setfield(L, -3, name);
    }
    lua_pop(L, 1);
    for (const SafeLibrary& library : kSafeLibraries) {
        luaL_requiref(L, library.name, library.open, 0);
        lua_setfield(L, -2, library.name);
    }
    lock_string_metatable(L);
    remove_field(L, "string", "dump");
    remove_field(L, "math", "randomseed");  // rng(seed) seeds the one stream there is
    add_protected_calls(L);
}

}  // namespace dynlab::inline scripting
