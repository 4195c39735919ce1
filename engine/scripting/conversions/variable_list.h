#pragma once
#include <lua.hpp>
#include <string>
#include <vector>

#include "data_io/values/described.h"

namespace dynlab::inline scripting {

/// A variable of a script as a list shows it.
struct ListedVariable {
    std::string name;
    std::string kind;           ///< "vector", "iddata", "number": as Lua or dynlab calls it
    std::string size;           ///< "500 x 1"; empty for what has none
    std::string text;           ///< the value in at most 60 bytes and " ..."
    std::vector<double> curve;  ///< at most 64 values of a signal, evenly spaced, for a thumbnail
};
DYNLAB_DESCRIBE(ListedVariable, name, kind, size, text, curve)

/// The script's own variables and functions, by name. Nothing of a script is called. May raise a Lua error (memory).
std::vector<ListedVariable> variable_list(lua_State* L);

}  // namespace dynlab::inline scripting
