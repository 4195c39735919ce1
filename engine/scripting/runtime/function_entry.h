#pragma once
#include <lua.hpp>
#include <span>
#include <string>

#include "scripting/runtime/option_entry.h"

namespace dynlab::inline scripting {

/// One function of the scripting language as the catalog, help and the registration know it.
struct FunctionEntry {
    const char* name;       ///< as a script writes it; "report.value" becomes a field of the table `report`
    const char* area;       ///< heading under which help() lists it
    const char* signature;  ///< "lsim(G, u, t_or_Ts, {options}) -> y": signature_text() names the options
    const char* summary;    ///< one line
    lua_CFunction function;
    OptionTables options = {};
    std::span<const ArgumentEntry> arguments = {};  ///< those that need words
};

/// "lsim(G, u, t_or_Ts, {hold =, x0 =}) -> y"; of more than four options the first three.
std::string signature_text(const FunctionEntry& function);

using FunctionEntries = std::span<const FunctionEntry>;

}  // namespace dynlab::inline scripting
