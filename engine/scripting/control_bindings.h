#pragma once
#include "scripting/function_entry.h"

namespace dynlab {

FunctionEntries control_functions();

}  // namespace dynlab
