#pragma once
#include <string>

namespace dynlab::inline cli {

/// For what a command gets as its script: throws the parser's error, before anything is read or written, for a file
/// whose ending tells that it is none (workflow/given_script.h).
void refuse_other_files(const std::string& given, const std::string& command);

}  // namespace dynlab::inline cli
