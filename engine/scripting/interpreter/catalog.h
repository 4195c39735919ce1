#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scripting/runtime/function_entry.h"
#include "scripting/runtime/shown_calls.h"
#include "scripting/runtime/type_entry.h"

namespace dynlab::inline scripting {

/// Every function that this layer gives to scripts, area by area: what help() lists, what each needs a help page for.
const std::vector<FunctionEntry>& catalog_of_functions();
/// The row of the catalog; nullptr for other names.
const FunctionEntry* find_function(const std::string& name);

/// The name that scripts have for an option of numerics, MaxIter for max_iterations; in backticks what is none. For
/// Reader::option_name.
std::string option_name(std::string_view member);
/// The names of numerics' options that have one in scripts.
std::vector<std::string> translated_options();

/// Every kind of object that scripts can hold.
const std::vector<TypeEntry>& catalog_of_types();

/// The functions of the catalog that show what they give.
const ShownCalls& shown_calls();

}  // namespace dynlab::inline scripting
