#pragma once
#include <string>
#include <vector>

#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// A function of a script. The object keeps it alive.
class ScriptFunction {
  public:
    ScriptFunction(lua_State* L, int index);
    ~ScriptFunction();
    ScriptFunction(const ScriptFunction&) = delete;
    ScriptFunction& operator=(const ScriptFunction&) = delete;
    lua_State* state() const { return L_; }
    void push() const;

  private:
    lua_State* L_;
    int reference_;
};

/// Calls the function below its arguments on the stack, so that no Lua error passes through numerics. Throws the
/// script's own error as InvalidArgument, and `surplus` if the function returns more than `results` values.
void call_or_throw(lua_State* L, int arguments, int results, Message (*surplus)());

/// __index of a table by names, raises; upvalues: "state", "x", their names.
int refuse_name(lua_State* L);

/// Pushes a table of what `push(i)` pushes, by place and by name; another name is refused: "x has no state h3; ...".
template <class Push>
void push_by_name(lua_State* L, const char* kind, const char* table, const std::vector<std::string>& names,
                  const Push& push) {
    lua_createtable(L, static_cast<int>(names.size()), static_cast<int>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
        push(static_cast<Index>(i));
        lua_pushvalue(L, -1);
        lua_setfield(L, -3, names[i].c_str());
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    lua_createtable(L, 0, 1);
    lua_pushstring(L, kind);
    lua_pushstring(L, table);
    lua_pushstring(L, fmt::format("{}", fmt::join(names, ", ")).c_str());
    lua_pushcclosure(L, refuse_name, 3);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
}

}  // namespace dynlab::inline scripting
