#pragma once
#include <lua.hpp>
#include <span>
#include <string>
#include <string_view>

#include "base/message.h"
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

/// The present name of a function that was renamed; empty for every other name. Scripts with the earlier names run
/// until the end of 2027.
std::string_view present_name(std::string_view earlier);

/// The note for a script with an earlier name.
Message renamed(std::string_view earlier);

using FunctionEntries = std::span<const FunctionEntry>;

}  // namespace dynlab::inline scripting
