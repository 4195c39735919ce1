#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "documents/percent_script.h"

namespace dynlab::inline documents {

/// Reads the header that starts in the first line (or the second, after `#!`) and returns how many lines were used;
/// 0 when there is none. Throws DocumentError with the file and line of each mistake, a line of the
/// message each.
std::size_t read_script_header(const std::vector<std::string>& lines, const std::filesystem::path& file,
                               ScriptHeader& header);

}  // namespace dynlab::inline documents
