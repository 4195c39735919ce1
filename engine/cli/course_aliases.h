#pragma once
#include <string>
#include <vector>

namespace dynlab::inline cli {

/// The words of a command line (without the program's name) in which an old name of a command of `dynlab course` stands
/// as the new one; `note` says so, where there was one. Old names work until the end of 2027.
std::vector<std::string> with_new_names(std::vector<std::string> words, std::string& note);

}  // namespace dynlab::inline cli
