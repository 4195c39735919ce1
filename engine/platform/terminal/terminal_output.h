#pragma once
#include <cstddef>
#include <string>

namespace dynlab::inline platform {

/// The line of the terminal that standard error is, rewritten in place.
void show_terminal_line(const std::string& text);  ///< cut where the line ends
void clear_terminal_line();

/// On standard output, at once and as it is.
void print_now(const std::string& text);
/// The same of a text that may come from others: a terminal would obey it (terminal_text), a file gets it as it is.
void print_shown(const std::string& text);

/// Columns of the terminal that the descriptor is; `otherwise` where it is none.
std::size_t terminal_columns(int descriptor, std::size_t otherwise);
/// Columns of standard output to fill with text: the terminal's, up to what is easy to read; `otherwise` in a pipe.
std::size_t columns_of_text(std::size_t otherwise);
/// Whether what is printed may be colored: on a terminal, unless NO_COLOR says otherwise.
bool in_color();

}  // namespace dynlab::inline platform
