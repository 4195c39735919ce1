#pragma once
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

FunctionEntries idgrey_functions();
FunctionEntries greyest_functions();

}  // namespace dynlab::inline scripting
