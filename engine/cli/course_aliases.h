#pragma once
#include <string>
#include <vector>

namespace dynlab::inline cli {

/// The words of a command line (without the program's name) with new names instead of old names of commands. `note`
/// names both if there was an old one. Old names work until the end of 2027.
std::vector<std::string> with_new_names(std::vector<std::string> args, std::string& note);

}  // namespace dynlab::inline cli
