#pragma once
#include <vector>

#include "scripting/runtime/function_entry.h"
#include "scripting/runtime/shown_calls.h"
#include "scripting/runtime/type_entry.h"

namespace dynlab::inline scripting {

/// Every function that this layer gives to scripts, area by area: what help() lists, what each needs a help page for.
const std::vector<FunctionEntry>& catalogue_of_functions();
/// The row of the catalogue; nullptr for other names.
const FunctionEntry* find_function(const std::string& name);

/// Every kind of object that scripts can hold.
const std::vector<TypeEntry>& catalogue_of_types();

/// The functions of the catalogue that show what they give.
const ShownCalls& shown_calls();

}  // namespace dynlab::inline scripting
