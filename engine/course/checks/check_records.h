#pragma once
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline course {

/// What checks.lua may call to see other records than those that load() gives, and what theory says of a record:
/// hidden, truth. Their state is the CheckSession that they are added with.
FunctionEntries check_record_functions();

/// For the engine: _record(name, specimen, seed) leaves what a declared rig makes in the session.
FunctionEntries record_function();

}  // namespace dynlab::inline course
