#pragma once
#include <filesystem>
#include <string_view>

namespace dynlab::inline platform {

/// Writes a file atomically that only its owner can read. A symbolic link that another user may have put at `file` is
/// replaced and never followed. Throws EnvironmentError as write_file_atomically does.
void write_plain_file(const std::filesystem::path& file, std::string_view content);

}  // namespace dynlab::inline platform
