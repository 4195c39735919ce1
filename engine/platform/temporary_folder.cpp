#include "platform/temporary_folder.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string>

#include "platform/error.h"
#include "platform/locks/abandoned_folders.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

/// A lock on each folder in use: it goes with the process, so that what a killed one left can be told and removed.
class FoldersInUse {
  public:
    void add(const std::filesystem::path& folder) {
        FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (file) ::flock(file.get(), LOCK_SH | LOCK_NB);
        const std::lock_guard lock(mutex_);
        files_.insert_or_assign(folder, std::move(file));
    }
    void remove(const std::filesystem::path& folder) {
        const std::lock_guard lock(mutex_);
        files_.erase(folder);
    }

  private:
    std::mutex mutex_;
    std::map<std::filesystem::path, FileDescriptor> files_;
};

FoldersInUse& folders_in_use() {
    static FoldersInUse* const folders = new FoldersInUse;  // outlives every other object
    return *folders;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    const std::filesystem::path parent = parent_of_temporary_folders();
    std::string pattern = parent.string() + "/dynlab-XXXXXX";
    if (!::mkdtemp(pattern.data()))
        throw EnvironmentError("cannot make a temporary folder in " + parent.string() + ": " + system_reason(errno));
    path_ = pattern;
    folders_in_use().add(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    folders_in_use().remove(path_);
}

}  // namespace dynlab::inline platform
