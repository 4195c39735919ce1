#pragma once
#include <cstddef>
#include <lua.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

/// The possible texts at the cursor.
struct Completion {
    std::size_t typed = 0;                ///< bytes before the cursor that each candidate starts with
    std::vector<std::string> candidates;  ///< whole words, sorted, each once
    std::string note;                     ///< the function's signature when there is nothing to choose
    /// The longest text that all candidates go on with; `closing` after a single one.
    std::string common_rest() const;
    std::string closing;
};

/// Completes the end of `text` (all lines of the statement up to the cursor): variables, functions and words of Lua;
/// after a dot or colon the fields or methods of the value before it; options inside the braces of a call; names of
/// data sets and files in load("..."), of functions in help("..."). Values are looked up without calling anything a
/// script defined: metamethods stay out, only the read-only fields of dynlab's own objects are computed.
Completion complete(lua_State* L, std::string_view text);

/// The call of a dynlab function that contains the end of a text.
struct CallAtCursor {
    const FunctionEntry* function;
    int argument;  ///< which one is being written, from 0
};
std::optional<CallAtCursor> call_around(lua_State* L, std::string_view text);
const FunctionEntry* function_called(lua_State* L, std::string_view name);  ///< nullptr for another name

}  // namespace dynlab::inline scripting
