#pragma once
#include <lua.hpp>
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline scripting {

/// Pushes a vector whose values can be read by these names, too: v.k1.
void push_named_vector(lua_State* L, const Vector& values, const std::vector<std::string>& names);

}  // namespace dynlab::inline scripting
