#pragma once
#include "scripting/function_entry.h"

namespace dynlab {

/// Functions that repeat estimations: over structures and over noise.
FunctionEntries order_functions();
FunctionEntries study_functions();

}  // namespace dynlab
