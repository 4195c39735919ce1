#pragma once
#include <filesystem>
#include <string_view>

namespace dynlab::inline platform {

/// Whole or not at all, for its owner only, whatever was in its place before: a link that another user may have put
/// there is replaced and never followed. Throws EnvironmentError as write_file_atomically does.
void write_plain_file(const std::filesystem::path& file, std::string_view content);

}  // namespace dynlab::inline platform
