#pragma once
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

/// Uncertainty beyond the covariance.
FunctionEntries interval_functions();

}  // namespace dynlab::inline scripting
