#pragma once
#include <memory>
#include <optional>
#include <string>

struct lua_State;

namespace dynlab::inline scripting {

/// Reads Lua text in a separate state that runs nothing.
class LuaReader {
  public:
    LuaReader();
    /// Lua's message of a syntax error ("s:LINE: ..."), nothing for text that is Lua.
    std::optional<std::string> error_of(const std::string& code);

  private:
    std::unique_ptr<lua_State, void (*)(lua_State*)> state_;
};

}  // namespace dynlab::inline scripting
