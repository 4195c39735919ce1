#include "scripting/arguments/script_function.h"

namespace dynlab::inline scripting {

ScriptFunction::ScriptFunction(lua_State* L, int index) : L_(context_of(L).main != nullptr ? context_of(L).main : L) {
    lua_pushvalue(L, index);
    reference_ = luaL_ref(L, LUA_REGISTRYINDEX);
}

ScriptFunction::~ScriptFunction() {
    luaL_unref(L_, LUA_REGISTRYINDEX, reference_);
}

void ScriptFunction::push() const {
    lua_rawgeti(L_, LUA_REGISTRYINDEX, reference_);
}

void call_or_throw(lua_State* L, int arguments, int results, const char* surplus) {
    if (lua_pcall(L, arguments, results + 1, 0) != LUA_OK) {
        pass_stop_on(L);
        const std::string message = luaL_tolstring(L, -1, nullptr);
        lua_pop(L, 2);
        throw InvalidArgument(message);
    }
    const bool more = !lua_isnil(L, -1);
    lua_pop(L, more ? results + 1 : 1);
    if (more) throw InvalidArgument(surplus);
}

int refuse_name(lua_State* L) {
    const std::string kind = lua_tostring(L, lua_upvalueindex(1)), names = lua_tostring(L, lua_upvalueindex(3));
    raise_error(
        L, fmt::format("{} has no {} {}; {}", lua_tostring(L, lua_upvalueindex(2)), kind, luaL_tolstring(L, 2, nullptr),
                       names.empty() ? "there is none" : fmt::format("the {}s are {}", kind, names)));
}

}  // namespace dynlab::inline scripting
