#pragma once
#include <cstddef>
#include <lua.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dynlab::inline scripting {

/// What there is to say of the name at (or else last before) a byte of `text`: the help of a function of dynlab, or the
/// value of a variable. Nothing of a script is called.
std::optional<std::string> inspect(lua_State* L, std::string_view text, std::size_t cursor);

}  // namespace dynlab::inline scripting
