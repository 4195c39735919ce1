#pragma once
#include <string>
#include <string_view>

#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {

std::string utf8_of(char32_t c);  ///< of U+0000 to U+10FFFF

/// A letter without accent, in lower case: "É" -> "e", "Ł" -> "l", "Æ" -> "ae", a ligature -> its letters, full-width
/// and mathematical letters -> plain ones, Greek and Cyrillic capitals -> small ones (UTF-8). Other letters and digits
/// as they are; "" for what is no letter and no digit.
std::string folded_letter(char32_t c);

/// What leaves no trace when letters are compared: accents on their own or combining, the soft hyphen, signs without
/// width.
bool is_silent(char32_t c);

bool is_capital(char32_t c);    ///< of a script that knows capitals
bool is_ideograph(char32_t c);  ///< of a script that writes words without spaces: each stands for itself

}  // namespace dynlab::inline course
