#include "scripting/arguments/script_function.h"

#include "scripting/runtime/errors.h"

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

void call_or_throw(lua_State* L, int arguments, int results, Message (*surplus)()) {
    if (lua_pcall(L, arguments, results + 1, 0) != LUA_OK) {
        pass_stop_on(L);
        translate_value_on_top(L);
        const Message message = error_at(L, -1).with_place();
        lua_pop(L, 1);
        throw InvalidArgument(message);
    }
    const bool more = !lua_isnil(L, -1);
    lua_pop(L, more ? results + 1 : 1);
    if (more) throw InvalidArgument(surplus());
}

namespace {

Message no_such_name(const std::string& kind, const std::string& table, const std::string& name,
                     const std::string& names) {
    if (kind == "state")
        return names.empty() ? Message("{} has no state {}; it has no states", table, name)
                             : Message("{} has no state {}; the states are {}", table, name, names);
    if (kind == "parameter")
        return names.empty() ? Message("{} has no parameter {}; it has no parameters", table, name)
                             : Message("{} has no parameter {}; the parameters are {}", table, name, names);
    return names.empty() ? Message("{} has no input {}; it has no inputs", table, name)
                         : Message("{} has no input {}; the inputs are {}", table, name, names);
}

}  // namespace

int refuse_name(lua_State* L) {
    const std::string kind = lua_tostring(L, lua_upvalueindex(1)), table = lua_tostring(L, lua_upvalueindex(2)),
                      names = lua_tostring(L, lua_upvalueindex(3)), name = luaL_tolstring(L, 2, nullptr);
    raise_error(L, no_such_name(kind, table, name, names));
}

}  // namespace dynlab::inline scripting
