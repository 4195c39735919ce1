#pragma once
#include <lua.hpp>
#include <string>

#include "app/live/runner_messages.h"

namespace dynlab::inline app {

/// JSON for an editor, from the state of a script. The answer to the question
///   "complete"   {"typed", "candidates": [{"text", "note"}], "signature", "summary", "argument"}: possible texts at
///                the end of question.text, and the call around it, with the 0-based number of the argument
///   "help"       {"text"}: the value or the help of the name at question.cursor of question.text
///   "variables"  [{"name", "kind", "size", "text", "curve": [numbers]}]
std::string answer_about_state(lua_State* L, const RunOrder& question);

}  // namespace dynlab::inline app
