#pragma once
#include <string>

namespace dynlab::inline platform {

/// A word of a command that is shown to be copied: as it is where a shell takes it so, else in single quotes.
std::string shell_word(const std::string& word);

}  // namespace dynlab::inline platform
