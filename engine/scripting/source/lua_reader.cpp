#include "scripting/source/lua_reader.h"

#include <lua.hpp>

namespace dynlab::inline scripting {

LuaReader::LuaReader() : state_(luaL_newstate(), lua_close) {}

std::optional<std::string> LuaReader::error_of(const std::string& code) {
    if (!state_) return "no memory";
    lua_State* L = state_.get();
    lua_settop(L, 0);
    if (luaL_loadbufferx(L, code.data(), code.size(), "=s", "t") == LUA_OK) return std::nullopt;
    std::size_t length = 0;
    const char* text = lua_tolstring(L, -1, &length);
    return std::string(text, length);
}

}  // namespace dynlab::inline scripting
