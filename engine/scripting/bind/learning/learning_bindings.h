#pragma once
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

/// Methods that learn equations from data.
FunctionEntries learning_functions();

}  // namespace dynlab::inline scripting
