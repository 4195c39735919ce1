#pragma once
#include <lua.hpp>
#include <optional>
#include <string>

namespace dynlab::inline scripting {

/// What load() knows of a column; what is computed from the column knows nothing.
struct ColumnOrigin {
    std::string unit = {};   ///< empty when unknown
    double Ts = 0;           ///< s, by the time of its file; 0 when unknown or uneven
    std::string clock = {};  ///< column of that time
};

/// Notes the origin of the vector at `index`, for as long as the vector lives.
void set_column_origin(lua_State* L, int index, const ColumnOrigin& origin);
/// The one noted for the value at `index`.
ColumnOrigin column_origin(lua_State* L, int index);

}  // namespace dynlab::inline scripting
