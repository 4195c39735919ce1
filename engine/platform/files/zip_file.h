#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace dynlab::inline platform {

/// A zip of these files, name in the archive -> content, none of them compressed (APPNOTE.TXT 6.3.10, PKWARE). Equal
/// contents give equal bytes on every machine, in a browser as well: names are sorted, in UTF-8, times and rights are
/// fixed. Throws EnvironmentError for more than the format can hold: 65,534 files, 4 GB.
std::string zip_of(const std::map<std::string, std::string>& contents);

/// Writes it, whole or not at all.
void write_zip(const std::filesystem::path& file, const std::map<std::string, std::string>& contents);

}  // namespace dynlab::inline platform
