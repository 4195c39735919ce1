#include "scripting/bind/grey_box/script_values.h"

namespace dynlab::inline scripting {

void push_numbers(lua_State* L, const char* kind, const char* table, const Names& names, const Vector& values) {
    push_by_name(L, kind, table, names, [&](Index i) { lua_pushnumber(L, values[i]); });
}

void push_inputs(lua_State* L, const Vector& u, bool indexed) {
    if (u.size() == 1 && !indexed) return lua_pushnumber(L, u[0]);
    lua_createtable(L, static_cast<int>(u.size()), 0);
    for (Index i = 0; i < u.size(); ++i) {
        lua_pushnumber(L, u[i]);
        lua_rawseti(L, -2, i + 1);
    }
}

std::optional<double> number_at_top(lua_State* L) {
    if (lua_type(L, -1) == LUA_TNUMBER) return lua_tonumber(L, -1);
    NumericBlock* block = to_vector(L, -1);
    if (block != nullptr && block->rows == 1) return block->data()[0];
    return std::nullopt;
}

Vector numbers_on_top(lua_State* L, const RequestedValues& requested) {
    const std::vector<double> values = read_list<double>(L, requested, [L] { return number_at_top(L); });
    return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

}  // namespace dynlab::inline scripting
