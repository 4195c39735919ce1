#pragma once
#include <string>
#include <vector>

#include "numerics/criteria/function_library.h"
#include "numerics/signals/iddata.h"
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// The function(x, u) of a script at stack index `index` as a library: x and u are tables of vectors, by place and by
/// the names that the data give them, and it returns a list of vectors (or numbers, for constants), one for each
/// function. It is called once to see how many there are. `names` are theirs, f1, f2, ... when empty. Throws
/// InvalidArgument for another result, or another number of names.
FunctionLibrary lua_library(const Call& call, int index, const IdData& data, std::vector<std::string> names);

}  // namespace dynlab::inline scripting
