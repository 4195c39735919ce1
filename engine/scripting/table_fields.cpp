#include "scripting/table_fields.h"

namespace dynlab {

void set_number(lua_State* L, const char* name, double value) {
    lua_pushnumber(L, value);
    lua_setfield(L, -2, name);
}
void set_whole(lua_State* L, const char* name, Index value) {
    lua_pushinteger(L, value);
    lua_setfield(L, -2, name);
}
void set_flag(lua_State* L, const char* name, bool value) {
    lua_pushboolean(L, value);
    lua_setfield(L, -2, name);
}
void set_text(const Call& call, const char* name, const std::string& value) {
    call.give(value);
    lua_setfield(call.state(), -2, name);
}
void set_texts(const Call& call, const char* name, const std::vector<std::string>& texts) {
    lua_createtable(call.state(), static_cast<int>(texts.size()), 0);
    for (std::size_t i = 0; i < texts.size(); ++i) {
        call.give(texts[i]);
        lua_rawseti(call.state(), -2, static_cast<lua_Integer>(i + 1));
    }
    lua_setfield(call.state(), -2, name);
}
void set_vector(const Call& call, const char* name, const VectorView& values) {
    call.give_vector(values);
    lua_setfield(call.state(), -2, name);
}
void set_matrix(const Call& call, const char* name, const MatrixView& values) {
    call.give_matrix(values);
    lua_setfield(call.state(), -2, name);
}

}  // namespace dynlab
