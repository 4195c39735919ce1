#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace dynlab::inline course {

/// Writes a zip of these files, name in the archive -> content, whole or not at all. Equal contents give equal bytes on
/// every machine: names are sorted, times and rights are fixed. Throws EnvironmentError.
void write_zip(const std::filesystem::path& file, const std::map<std::string, std::string>& contents);

}  // namespace dynlab::inline course
