#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline platform {

/// What the standard library's functions for files throw, in the words of our own messages: "cannot make the folder
/// analysis_out: permission denied".
std::string file_error_sentence(const std::filesystem::filesystem_error& error);

}  // namespace dynlab::inline platform
