#pragma once
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

/// Functions that repeat estimations: over structures and over noise.
FunctionEntries order_functions();
FunctionEntries study_functions();

}  // namespace dynlab::inline scripting
