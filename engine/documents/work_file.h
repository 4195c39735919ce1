#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace dynlab::inline documents {

/// Files of a private working folder: written and read without the care that results need (no sync, no rename).
void write_work_file(const std::filesystem::path& file, std::string_view content);  ///< throws EnvironmentError
std::string read_work_file(const std::filesystem::path& file);                      ///< empty when there is none

}  // namespace dynlab::inline documents
