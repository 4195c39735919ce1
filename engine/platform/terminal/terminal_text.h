#pragma once
#include <string>
#include <string_view>

namespace dynlab::inline platform {

/// Whether a terminal or viewer would interpret the character instead of showing it: control characters, characters
/// without width, characters that change the direction of writing, and U+FFFD.
bool is_terminal_control(char32_t c);

/// A text of any origin as it may be shown on a terminal or kept in a log: what is_terminal_control, line ends and tabs
/// excepted, and broken UTF-8 become '?'.
std::string terminal_text(std::string_view utf8);

/// The same on one line: line ends and tabs become spaces. For names in lists and logs, whose lines a line end in a
/// name would forge.
std::string terminal_line(std::string_view utf8);

/// A word of a command that is shown to be copied: as it is where a shell takes it so, else in single quotes.
std::string shell_word(const std::string& word);

}  // namespace dynlab::inline platform
