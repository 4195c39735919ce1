#pragma once
#include <string>
#include <vector>

#include "data_io/values/described.h"

namespace dynlab::inline app {

/// A field of a step's table of options, as it is written.
struct StepOption {
    std::string key, text;
};
DYNLAB_DESCRIBE(StepOption, key, text)

/// A statement of a session's script that controls can show: a value or the results of one call, given to names.
/// `G = srivc(data, {1, 2, 0}, {lambda = 3})` has the function srivc, the arguments "data" and "{1, 2, 0}", and the
/// option lambda; `z = data:range(1, 200)` the function range of the receiver data; `G0 = 2/(s + 1)` no function and
/// one argument. A line "-- off: STATEMENT" is a step that was switched off.
struct SessionStep {
    int first_line = 1, last_line = 1;
    std::vector<std::string> names;      ///< that get the values; none of a bare call
    bool local = false;                  ///< the names follow "local"
    std::string receiver, function;      ///< of the call
    bool braces = false;                 ///< f{...}: the table is the only argument
    std::vector<std::string> arguments;  ///< as they are written, without the table of options at the end
    std::vector<StepOption> options;
    std::string rest;  ///< the text after it in its last line: a comment
    bool on = true;
    bool broken = false;  ///< no statement of Lua: its only argument is what was typed behind the names, in one line
};
DYNLAB_DESCRIBE(SessionStep, first_line, last_line, names, local, receiver, function, braces, arguments, options, rest,
                on, broken)

/// The steps of a script, in order: statements outside of functions, loops and conditions that begin a line and end
/// one, without remarks inside. What is written in another way is no step, and stays as it is. A statement that is not
/// finished ends, as a broken step, before the next line that begins as an assignment or a cell does.
std::vector<SessionStep> session_steps(const std::string& source);

/// Lines of a script that are replaced.
struct LineEdit {
    int first = 1;     ///< the first line that goes; with `last` below it nothing goes, and the text comes before it
    int last = 0;      ///< the last one
    std::string text;  ///< what comes in their place, without the last line's end; empty: nothing
};
DYNLAB_DESCRIBE(LineEdit, first, last, text)

/// The script with the edits made, which speak of lines as they were and do not overlap. Throws ValueError for lines
/// that the script does not have and edits that overlap.
std::string with_edits(const std::string& source, std::vector<LineEdit> edits);

}  // namespace dynlab::inline app
