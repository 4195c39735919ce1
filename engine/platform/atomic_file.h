#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace dynlab::inline platform {

/// Writes `content` to a temporary file beside `file`, syncs, then renames: `file` appears whole or stays as
/// it was. Throws EnvironmentError that names the file and the system's reason (no such folder, not writable,
/// disk full).
void write_file_atomically(const std::filesystem::path& file, std::string_view content);
/// Moves or copies a finished file to its destination with the same promise, across file systems too.
void place_file_atomically(const std::filesystem::path& from, const std::filesystem::path& to);
std::string read_file(const std::filesystem::path& file);  ///< throws EnvironmentError

}  // namespace dynlab::inline platform
