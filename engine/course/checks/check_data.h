#pragma once
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline course {

/// Functions that checks.lua may call to get data sets other than those of load(), and the theoretical values of a data
/// set: hidden, truth. Their state is the CheckSession that they are registered with.
FunctionEntries check_data_functions();

/// For the engine: _record(name, variant, seed) stores the data set of a declared simulated plant in the session.
FunctionEntries data_function();

}  // namespace dynlab::inline course
