#pragma once
#include <string_view>
#include <vector>

namespace dynlab::inline scripting {

/// A word or sign of Lua text, as the prompt needs it: to find statements and the text before the cursor.
struct LuaToken {
    enum class Kind { kName, kKeyword, kNumber, kString, kSign, kUnfinished };
    Kind kind;
    std::string_view text;  ///< part of the text that was taken apart; strings with their quotes
    std::size_t begin = 0;  ///< offset of its first character
    std::size_t end() const { return begin + text.size(); }
    bool is(std::string_view word) const { return text == word && kind != Kind::kString && kind != Kind::kUnfinished; }
};

/// The tokens of any text, Lua or not, without white space and comments. A string (or long comment) that is still open
/// at the end of its line, a long one at the end of the text, is of kind kUnfinished.
std::vector<LuaToken> lua_tokens(std::string_view text);

/// Whether the token i of `code` is the first of its line.
bool begins_line(std::string_view code, const std::vector<LuaToken>& tokens, std::size_t i);

/// The reserved words, sorted.
const std::vector<std::string_view>& lua_keywords();

bool is_name_character(char c);                ///< letter, digit or underscore (ASCII)
bool is_variable_name(std::string_view word);  ///< begins with no digit, and is not reserved

}  // namespace dynlab::inline scripting
