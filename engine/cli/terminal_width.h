#pragma once
#include <cstddef>

namespace dynlab::inline cli {

/// Columns to fill with text: the terminal's, up to what is easy to read, or the usual ones in a pipe.
std::size_t terminal_width();

}  // namespace dynlab::inline cli
