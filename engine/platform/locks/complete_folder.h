#pragma once
#include <filesystem>
#include <functional>

namespace dynlab::inline platform {

/// Makes a folder that is there with everything that `fill` puts into it, or not at all: it is filled under a name of
/// its own beside it, ".new-MACHINE-XXXXXX", and renamed. What killed calls left there is removed first; of two calls
/// at once for one folder the first to end makes it. An empty folder may be there already. Throws EnvironmentError
/// where another file or folder is there, or where none can be made, and what `fill` throws.
void make_complete_folder(const std::filesystem::path& folder,
                          const std::function<void(const std::filesystem::path& growing)>& fill);

}  // namespace dynlab::inline platform
