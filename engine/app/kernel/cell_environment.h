#pragma once
#include "app/live/channel.h"

namespace dynlab::inline app {

/// The process that runs the cells of a notebook, and answers what is asked of its variables, until the other end of
/// the line is closed. Never returns. SIGINT ends the cell that runs.
[[noreturn]] void serve_cells(Channel line);

}  // namespace dynlab::inline app
