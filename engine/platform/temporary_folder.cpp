#include "platform/temporary_folder.h"

#include <cerrno>
#include <mutex>
#include <set>
#include <string>

#include "platform/error.h"
#include "platform/locks/abandoned_folders.h"
#include "platform/locks/in_use.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

/// True for the first call with this parent.
bool is_new_parent(const fs::path& parent) {
    static std::mutex mutex;
    static std::set<fs::path> parents;
    const std::lock_guard lock(mutex);
    return parents.insert(parent).second;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    const fs::path parent = parent_of_temporary_folders();
    if (is_new_parent(parent)) remove_abandoned_folders();
    path_ = make_folder_in_use(parent, beginning_of_temporary_folders());
    if (path_.empty())
        throw EnvironmentError("cannot create a temporary folder in {}: {}", parent.string(), system_reason(errno));
    ends_ = EndsWithProgram(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    release_folder_in_use(path_);
}

}  // namespace dynlab::inline platform
