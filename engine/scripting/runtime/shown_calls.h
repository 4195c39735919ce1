#pragma once
#include <string>

namespace dynlab::inline scripting {

/// The source with every call, alone in its lines, of a function that only computes made into one that shows what it
/// gives, several results with their names: "damp(G)" as MATLAB shows it. These are the functions of the catalogue
/// whose signature has results; those that draw or print them, or are called for what they do, stay as they are. So
/// does a call with a semicolon behind it, and that of a name that the script itself has defined before it, in a block
/// that is open there or for all.
std::string with_shown_calls(const std::string& source);

}  // namespace dynlab::inline scripting
