#pragma once

namespace dynlab::inline cli {

/// Whether what is printed may be coloured: on a terminal, unless NO_COLOR says otherwise.
bool in_colour();

}  // namespace dynlab::inline cli
