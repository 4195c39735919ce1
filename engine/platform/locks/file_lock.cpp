#include "platform/locks/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>

#include "platform/error.h"

namespace dynlab::inline platform {

FileLock::FileLock(const std::filesystem::path& file) {
    constexpr mode_t kOwnerOnly = 0600;
    file_ = FileDescriptor(
        retry_interrupted([&] { return ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kOwnerOnly); }));
    if (!file_) throw EnvironmentError("cannot create the lock file {}: {}", file.string(), system_reason(errno));
    held_ = retry_interrupted([&] { return ::flock(file_.get(), LOCK_EX | LOCK_NB); }) == 0;
}

}  // namespace dynlab::inline platform
