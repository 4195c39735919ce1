#pragma once
#include <string>
#include <vector>

namespace dynlab::inline cli {

/// Replaces an old name of a command in the args of a command line (without the program's name): of `dynlab site`,
/// which was `dynlab manual`, and of commands of `dynlab course`. `note` says so where there was one. Old names work
/// until the end of 2027.
std::vector<std::string> with_new_names(std::vector<std::string> words, std::string& note);

}  // namespace dynlab::inline cli
