#include "platform/temporary_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "platform/error.h"
#include "platform/files/temporary_file.h"
#include "platform/locks/abandoned_folders.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

/// A lock on each folder in use: it goes with the process, so that what a killed one left can be told and removed.
class FoldersInUse {
  public:
    void add(const fs::path& folder, FileDescriptor locked) {
        const std::lock_guard lock(mutex_);
        locked_.insert_or_assign(folder, std::move(locked));
    }
    void remove(const fs::path& folder) {
        const std::lock_guard lock(mutex_);
        locked_.erase(folder);
    }
    /// True for the first call with this parent.
    bool is_new_parent(const fs::path& parent) {
        const std::lock_guard lock(mutex_);
        return parents_.insert(parent).second;
    }

  private:
    std::mutex mutex_;
    std::map<fs::path, FileDescriptor> locked_;
    std::set<fs::path> parents_;
};

FoldersInUse& folders_in_use() {
    static FoldersInUse* const folders = new FoldersInUse;  // outlives every other object
    return *folders;
}

[[noreturn]] void fail_to_make_folder(const fs::path& parent) {
    throw EnvironmentError("cannot make a temporary folder in {}: {}", parent.string(), system_reason(errno));
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    const fs::path parent = parent_of_temporary_folders();
    if (folders_in_use().is_new_parent(parent)) remove_abandoned_folders();
    for (;;) {
        std::string path = parent / pattern_of_temporary_folders();
        if (!::mkdtemp(path.data())) fail_to_make_folder(parent);
        FileDescriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (!folder && errno != ENOENT) {
            const int reason = errno;
            ::rmdir(path.c_str());
            errno = reason;
            fail_to_make_folder(parent);
        }
        if (!folder || !lock_as_in_use(folder.get(), path)) {  // taken for a leftover, before it had its lock
            ::rmdir(path.c_str());
            continue;
        }
        path_ = path;
        ends_ = EndsWithProgram(path_);
        folders_in_use().add(path_, std::move(folder));
        return;
    }
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    folders_in_use().remove(path_);
}

}  // namespace dynlab::inline platform
