#pragma once
#include <string>
#include <string_view>

namespace dynlab::inline documents {

/// A text as a Lua literal in double quotes, on one line: quotes, backslashes and control characters are escaped, so
/// that the literal means exactly `text` and nothing in it can end it. Other bytes stay unchanged.
std::string lua_text(std::string_view text);

}  // namespace dynlab::inline documents
