#pragma once
#include <string>

namespace dynlab::inline scripting {

/// All functions of dynlab as the language server for Lua (LuaLS) reads them, a file that is never run: a `---@meta`
/// header, then for each function its summary, parameters, results and, where it takes options, a class that lists
/// these with the words of the help page. Made from the catalog of functions and the help pages.
std::string type_stubs();

}  // namespace dynlab::inline scripting
