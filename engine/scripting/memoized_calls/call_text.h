#pragma once
#include <lua.hpp>
#include <optional>
#include <string>

namespace dynlab::inline scripting {

/// What a call's text holds of large arguments: their kind and size, which costs nothing to look at, or their content
/// by its digest. Of all others it holds the values.
enum class LargeArguments { kBySize, kByContent };

/// A call as text: the function and its arguments, `first` to `last` on the stack, tables with all they hold. Equal
/// texts are equal calls. Nothing when an argument has no lasting content (see put_value) - by size, only some of those
/// are found.
std::optional<std::string> call_text(lua_State* L, const char* function, int first, int last, LargeArguments large);

}  // namespace dynlab::inline scripting
