#pragma once
#include <lua.hpp>
#include <vector>

#include "documents/run_record.h"

namespace dynlab::inline scripting {

/// The calls of the script's functions that lead to where a message handler is called, the innermost first: what was
/// called with which arguments, and the line that called it. Of a long chain its inner end and the line of the main
/// chunk. To be called by a message handler; never raises.
std::vector<RecordedCall> call_chain(lua_State* L);

}  // namespace dynlab::inline scripting
