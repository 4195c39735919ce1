#include "scripting/objects/units.h"

namespace dynlab::inline scripting {
namespace {

constexpr char kOriginsKey = 0;  // its address is the key in the registry

/// Pushes the table of origins by vector, whose keys do not keep the vectors alive.
void push_origins(lua_State* L) {
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kOriginsKey) == LUA_TTABLE) return;
    lua_pop(L, 1);
    lua_newtable(L);
    lua_createtable(L, 0, 1);
    lua_pushliteral(L, "k");
    lua_setfield(L, -2, "__mode");
    lua_setmetatable(L, -2);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kOriginsKey);
}

}  // namespace

void set_column_origin(lua_State* L, int index, const ColumnOrigin& origin) {
    index = lua_absindex(L, index);
    if (lua_type(L, index) != LUA_TUSERDATA) return;
    push_origins(L);
    lua_pushvalue(L, index);
    lua_createtable(L, 3, 0);
    lua_pushlstring(L, origin.unit.data(), origin.unit.size());
    lua_rawseti(L, -2, 1);
    lua_pushnumber(L, origin.Ts);
    lua_rawseti(L, -2, 2);
    lua_pushlstring(L, origin.clock.data(), origin.clock.size());
    lua_rawseti(L, -2, 3);
    lua_rawset(L, -3);
    lua_pop(L, 1);
}

ColumnOrigin column_origin(lua_State* L, int index) {
    index = lua_absindex(L, index);
    ColumnOrigin origin;
    if (lua_type(L, index) != LUA_TUSERDATA) return origin;
    push_origins(L);
    lua_pushvalue(L, index);
    if (lua_rawget(L, -2) == LUA_TTABLE) {
        lua_rawgeti(L, -1, 1);
        lua_rawgeti(L, -2, 2);
        lua_rawgeti(L, -3, 3);
        origin = {lua_tostring(L, -3), lua_tonumber(L, -2), lua_tostring(L, -1)};
        lua_pop(L, 3);
    }
    lua_pop(L, 2);
    return origin;
}

}  // namespace dynlab::inline scripting
