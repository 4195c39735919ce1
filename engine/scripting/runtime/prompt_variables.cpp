#include "scripting/runtime/prompt_variables.h"

namespace dynlab::inline scripting {
namespace {

char variables_key, declared_key;  // their addresses are registry keys

// The table of declared names holds false for an announced name and true once it was assigned.

/// __index: a variable that is nil, an announced or a global name.
int read_other(lua_State* L) {
    lua_pushvalue(L, 2);
    lua_rawget(L, lua_upvalueindex(1));
    if (lua_toboolean(L, -1)) {
        lua_pushnil(L);
        return 1;
    }
    lua_pushglobaltable(L);
    lua_pushvalue(L, 2);
    lua_gettable(L, -2);
    return 1;
}

/// __newindex: the first value of a declared name, or a global.
int write_other(lua_State* L) {
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL) {
        lua_pushvalue(L, 2);
        lua_pushboolean(L, 1);
        lua_rawset(L, lua_upvalueindex(1));
        lua_settop(L, 3);
        lua_rawset(L, 1);
        return 0;
    }
    lua_pushglobaltable(L);
    lua_replace(L, 1);
    lua_settop(L, 3);
    lua_settable(L, 1);
    return 0;
}

void set_with_declared(lua_State* L, const char* name, lua_CFunction function) {
    lua_rawgetp(L, LUA_REGISTRYINDEX, &declared_key);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

}  // namespace

void make_prompt_variables(lua_State* L) {
    lua_newtable(L);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &declared_key);
    lua_newtable(L);
    lua_createtable(L, 0, 3);
    set_with_declared(L, "__index", read_other);
    set_with_declared(L, "__newindex", write_other);
    lua_pushliteral(L, "variables");
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &variables_key);
}

void push_prompt_variables(lua_State* L) {
    lua_rawgetp(L, LUA_REGISTRYINDEX, &variables_key);
}

void announce_variables(lua_State* L, const std::vector<std::string>& names) {
    lua_rawgetp(L, LUA_REGISTRYINDEX, &declared_key);
    for (const std::string& name : names) {
        if (lua_getfield(L, -1, name.c_str()) == LUA_TNIL) {
            lua_pushboolean(L, 0);
            lua_setfield(L, -3, name.c_str());
        }
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

void clear_unassigned(lua_State* L, const std::vector<std::string>& names) {
    lua_rawgetp(L, LUA_REGISTRYINDEX, &declared_key);
    for (const std::string& name : names) {
        if (lua_getfield(L, -1, name.c_str()) == LUA_TBOOLEAN && !lua_toboolean(L, -1)) {
            lua_pushnil(L);
            lua_setfield(L, -3, name.c_str());
        }
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

}  // namespace dynlab::inline scripting
