#pragma once
#include <string>

namespace dynlab::inline platform {

/// The line of the terminal that standard error is, rewritten in place.
void show_terminal_line(const std::string& text);  ///< cut where the line ends
void clear_terminal_line();

}  // namespace dynlab::inline platform
