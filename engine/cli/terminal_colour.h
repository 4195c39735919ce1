#pragma once

namespace dynlab {

/// Whether what is printed may be coloured: on a terminal, unless NO_COLOR says otherwise.
bool in_colour();

}  // namespace dynlab
