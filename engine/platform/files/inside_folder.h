#pragma once
#include <filesystem>

namespace dynlab::inline platform {

/// The folder that holds `file`, as one can write it down: "." where the name has none.
std::filesystem::path folder_around(const std::filesystem::path& file);

/// Whether `file` lies in `folder` or below it, symbolic links followed. It need not exist.
bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace dynlab::inline platform
