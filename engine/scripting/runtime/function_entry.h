#pragma once
#include <lua.hpp>
#include <span>
#include <vector>

namespace dynlab::inline scripting {

/// One function of the scripting language as the catalogue, help and the registration know it.
struct FunctionEntry {
    const char* name;       ///< as a script writes it; "report.value" becomes a field of the table `report`
    const char* area;       ///< heading under which help() lists it
    const char* signature;  ///< "lsim(G, u, t_or_Ts, {hold =, x0 =}) -> y"
    const char* summary;    ///< one line
    lua_CFunction function;
};

using FunctionEntries = std::span<const FunctionEntry>;

/// Every function that this layer gives to scripts, area by area: what help() lists, what each needs a help page for.
const std::vector<FunctionEntry>& catalogue_of_functions();

}  // namespace dynlab::inline scripting
