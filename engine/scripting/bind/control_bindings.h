#pragma once
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

FunctionEntries control_functions();

}  // namespace dynlab::inline scripting
