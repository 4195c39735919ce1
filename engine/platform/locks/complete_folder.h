#pragma once
#include <filesystem>
#include <functional>

namespace dynlab::inline platform {

/// Creates a folder with everything that `fill` puts into it, or not at all: the folder is filled under a temporary
/// name next to it, ".new-MACHINE-XXXXXX", and renamed. Leftovers of killed calls are removed first; of two
/// simultaneous calls for one folder, the first to end creates it. An empty folder may already exist. Throws
/// EnvironmentError if another file or folder exists, or if the folder cannot be created, and whatever `fill` throws.
void make_complete_folder(const std::filesystem::path& folder,
                          const std::function<void(const std::filesystem::path& growing)>& fill);

}  // namespace dynlab::inline platform
