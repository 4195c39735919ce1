#include "scripting/conversions/table_fields.h"

#include <algorithm>

#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {

namespace {

/// __index of such a table; upvalue 1 is the name of the data, 2 the table of its hidden fields, if there are any.
int unknown_field(lua_State* L) {
    if (lua_istable(L, lua_upvalueindex(2))) {
        lua_pushvalue(L, 2);
        if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
        lua_pop(L, 1);
    }
    std::vector<std::string> names;
    collect_text_keys(L, 1, names);
    std::sort(names.begin(), names.end());
    const std::string requested = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : luaL_typename(L, 2);
    raise_error(L, Message("the data of '{}' have no variable '{}'; the variables are {}",
                           lua_tostring(L, lua_upvalueindex(1)), requested, listed(names)));
}

}  // namespace

void refuse_unknown_fields(lua_State* L, const std::string& name) {
    lua_createtable(L, 0, 2);
    lua_pushstring(L, name.c_str());
    lua_pushnil(L);
    lua_pushcclosure(L, unknown_field, 2);
    lua_setfield(L, -2, "__index");
    lua_pushliteral(L, "data");
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

void add_hidden_fields(lua_State* L) {
    luaL_getmetafield(L, -2, "__index");
    lua_insert(L, -2);
    lua_setupvalue(L, -2, 2);
    lua_pop(L, 1);
}

std::optional<std::string> name_of_refusing_table(lua_State* L, int index) {
    if (luaL_getmetafield(L, index, "__index") == LUA_TNIL) return {};
    std::optional<std::string> name;
    if (lua_tocfunction(L, -1) == unknown_field && lua_getupvalue(L, -1, 1) != nullptr) {
        name = lua_tostring(L, -1);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return name;
}

}  // namespace dynlab::inline scripting
