#pragma once
#include <lua.hpp>
#include <optional>
#include <string>

namespace dynlab::inline scripting {

/// Notes the unit of the vector at `index`, for as long as it lives; what is computed from it has none.
void remember_unit(lua_State* L, int index, const std::string& unit);
/// The unit noted for the value at `index`.
std::optional<std::string> remembered_unit(lua_State* L, int index);

}  // namespace dynlab::inline scripting
