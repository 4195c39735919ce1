#include "scripting/objects/units.h"

namespace dynlab::inline scripting {
namespace {

constexpr char kUnitsKey = 0;  // its address is the key in the registry

/// Pushes the table of units by vector, whose keys do not keep the vectors alive.
void push_remembered_units(lua_State* L) {
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kUnitsKey) == LUA_TTABLE) return;
    lua_pop(L, 1);
    lua_newtable(L);
    lua_createtable(L, 0, 1);
    lua_pushliteral(L, "k");
    lua_setfield(L, -2, "__mode");
    lua_setmetatable(L, -2);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kUnitsKey);
}

}  // namespace

void remember_unit(lua_State* L, int index, const std::string& unit) {
    index = lua_absindex(L, index);
    if (lua_type(L, index) != LUA_TUSERDATA) return;
    push_remembered_units(L);
    lua_pushvalue(L, index);
    lua_pushlstring(L, unit.data(), unit.size());
    lua_rawset(L, -3);
    lua_pop(L, 1);
}

std::optional<std::string> remembered_unit(lua_State* L, int index) {
    index = lua_absindex(L, index);
    if (lua_type(L, index) != LUA_TUSERDATA) return std::nullopt;
    push_remembered_units(L);
    lua_pushvalue(L, index);
    std::optional<std::string> unit;
    if (lua_rawget(L, -2) == LUA_TSTRING) unit = lua_tostring(L, -1);
    lua_pop(L, 2);
    return unit;
}

}  // namespace dynlab::inline scripting
