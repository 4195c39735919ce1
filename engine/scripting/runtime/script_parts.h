#pragma once
#include <string>
#include <vector>

#include "documents/percent_script.h"

namespace dynlab::inline scripting {

/// The code of a script that can run by itself once what stands before it has run: one code cell, or several where a
/// loop or a function goes over the end of a cell.
struct ScriptPart {
    int first_line = 1;              ///< in the script
    std::string code;                ///< the lines of the script from there on
    std::vector<std::string> cells;  ///< ids of its code cells
};

/// All code of a script, in order. Wrong syntax is a part, too: running it tells what is wrong.
std::vector<ScriptPart> script_parts(const PercentScript& script);

}  // namespace dynlab::inline scripting
