#include "platform/files/inside_folder.h"

#include <algorithm>

namespace dynlab::inline platform {

namespace fs = std::filesystem;

fs::path folder_around(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

bool is_inside(const fs::path& file, const fs::path& folder) {
    const fs::path inner = fs::weakly_canonical(file), outer = fs::weakly_canonical(folder);
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace dynlab::inline platform
