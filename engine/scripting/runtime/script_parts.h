#pragma once
#include <string>
#include <vector>

#include "documents/percent_script.h"

namespace dynlab::inline scripting {

/// The code of a script that can run as a unit once the code before it has run: one code cell, or several if a loop or
/// a function extends over the end of a cell.
struct ScriptPart {
    int first_line = 1;              ///< in the script
    std::string code;                ///< the lines of the script from there on
    std::vector<std::string> cells;  ///< ids of its code cells
};

/// All code of a script, in order. Code with a syntax error is a part, too: running the part reports the error.
std::vector<ScriptPart> script_parts(const PercentScript& script);

}  // namespace dynlab::inline scripting
