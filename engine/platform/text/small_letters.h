#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline platform {

/// The letters of ASCII in lower case, all other bytes as they are (UTF-8 stays UTF-8).
std::string in_small_letters(std::string text);

/// The ending of a file's name in lower case, with its dot: ".pdf" of "Report.PDF"; empty without one.
std::string ending_of(const std::filesystem::path& file);

}  // namespace dynlab::inline platform
