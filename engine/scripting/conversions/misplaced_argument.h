#pragma once
#include "base/message.h"

struct lua_State;

namespace dynlab::inline scripting {

/// Refuses a value that belongs elsewhere: the argument in a table of options, or data and model in the wrong order.
void refuse_misplaced(lua_State* L, int index, const Message& label, const Message& requested, const Message& given);

}  // namespace dynlab::inline scripting
