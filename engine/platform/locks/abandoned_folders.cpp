#include "platform/locks/abandoned_folders.h"

#include <cstdlib>

#include "platform/locks/in_use.h"

namespace dynlab::inline platform {

namespace fs = std::filesystem;

fs::path parent_of_temporary_folders() {
    const char* const parent = std::getenv("TMPDIR");
    return parent && *parent ? parent : "/tmp";
}

std::string beginning_of_temporary_folders() {
    return prefix_in_use("dynlab-");
}

std::vector<fs::path> remove_abandoned_folders() {
    return remove_unused(parent_of_temporary_folders(), beginning_of_temporary_folders(), Leftovers::kFolders);
}

}  // namespace dynlab::inline platform
