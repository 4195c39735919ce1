#pragma once
#include <string>
#include <vector>

#include "scripting/runtime/shown_calls.h"

namespace dynlab::inline scripting {

/// What was typed at the prompt, one line or several, made ready to run.
struct PromptStatement {
    enum class Kind {
        kEmpty,       ///< white space and comments
        kIncomplete,  ///< more lines must follow
        kReady,
        kLeave,  ///< quit or exit
    };
    Kind kind = Kind::kEmpty;
    std::string source;  ///< as typed, for messages
    /// Lua text with the lines of `source`. An expression alone returns its values; the locals of the outermost level
    /// are assignments, so that later statements still see them. Wrong text stays as it is.
    std::string code;
    std::vector<std::string> variables;  ///< names that were declared local on the outermost level
    bool silent = false;                 ///< ended by a semicolon: values are not shown
};

/// Takes `= x`, `help NAME`, `help`, `quit` and `exit` (with or without brackets) as the habits they are. `shown`: the
/// functions whose calls show their values.
PromptStatement read_statement(const std::string& source, const ShownCalls& shown);
/// A piece of a script instead: its values are shown where with_shown_expressions says so, and no word is a habit.
PromptStatement read_script_part(const std::string& source, const ShownCalls& shown);
/// A cell of a notebook: a piece of a script whose last statement, where it is a call of any function, shows its
/// values.
PromptStatement read_cell(const std::string& source, const ShownCalls& shown);

}  // namespace dynlab::inline scripting
