#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "documents/percent_script.h"

namespace dynlab::inline documents {

/// Reads the header that starts in the first line (or the second, after `#!`) and returns how many lines were used;
/// 0 when there is none. Throws DocumentError with the file and line of each mistake, a line of the
/// message each.
std::size_t read_script_header(const std::vector<std::string>& lines, const std::filesystem::path& file,
                               ScriptHeader& header);

/// The language that the header of a script names; "en" where it names none. The header may have errors elsewhere.
/// Empty for a language without a catalog.
std::string language_of_script(std::string_view source);

}  // namespace dynlab::inline documents
