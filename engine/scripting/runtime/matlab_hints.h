#pragma once
#include <string>
#include <string_view>

#include "base/message.h"

namespace dynlab::inline scripting {

/// How a habit from MATLAB or another language is written in Lua; nothing (nullptr, empty) where none is recognized.
const Message* matlab_name_hint(std::string_view name);
/// The same for a field or method of an object of this type.
const Message* foreign_member_hint(std::string_view type, std::string_view name);
/// For a line that Lua cannot read; `near` is the word at which it stopped.
Message matlab_syntax_hint(const std::string& line, const std::string& near);
/// A hint for a word that is no variable, if it follows the % or # of a comment.
Message comment_hint(const std::string& line, const std::string& name);
/// Whether a line begins as a comment does in other languages.
bool begins_foreign_comment(const std::string& line);
/// For a word that is no function, if a string follows it without a space as in Python: f"gain {K}".
Message string_prefix_hint(const std::string& line, const std::string& name);
/// For a line that Lua read to its end, but whose block it never found closed, as Python writes one: for k in x:
Message colon_block_hint(const std::string& line);
/// For a line of one word that opens a block elsewhere and is none here: "try".
Message lone_word_hint(const std::string& line);
/// About the first character outside of texts that no program can hold: typographic quotes, dashes, accents.
Message foreign_character_sentence(const std::string& line);

}  // namespace dynlab::inline scripting
