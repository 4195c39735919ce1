#pragma once
#include "cli/commands.h"

namespace dynlab::inline cli {

/// The FigureView of the program with pages; the page ends with the listener that it gives.
FigureListener view_in_browser();

}  // namespace dynlab::inline cli
