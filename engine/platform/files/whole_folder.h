#pragma once
#include <filesystem>
#include <functional>

namespace dynlab::inline platform {

/// Makes a folder that is there with everything that `fill` puts into it, or not at all: it is filled under another
/// name beside it, ".NAME.new", and renamed. What an interrupted call left under that name is removed by the next one.
/// An empty folder may be there already. Throws EnvironmentError where another file or folder is there, or where none
/// can be made, and what `fill` throws.
void make_whole_folder(const std::filesystem::path& folder,
                       const std::function<void(const std::filesystem::path& growing)>& fill);

}  // namespace dynlab::inline platform
