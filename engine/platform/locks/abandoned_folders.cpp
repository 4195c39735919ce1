#include "platform/locks/abandoned_folders.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <string>

#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

bool is_abandoned(const fs::path& folder, std::chrono::seconds age) {
    struct stat status {};
    const FileDescriptor open_folder(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!open_folder || ::fstat(open_folder.get(), &status) != 0) return false;
    if (status.st_uid != ::geteuid() || status.st_ctime + age.count() > std::time(nullptr)) return false;
    return ::flock(open_folder.get(), LOCK_EX | LOCK_NB) == 0;
}

}  // namespace

fs::path parent_of_temporary_folders() {
    const char* const parent = std::getenv("TMPDIR");
    return parent && *parent ? parent : "/tmp";
}

int remove_abandoned_folders(std::chrono::seconds age) {
    int removed = 0;
    std::error_code error;
    for (fs::directory_iterator entry(parent_of_temporary_folders(), error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        constexpr std::size_t kNameLength = sizeof "dynlab-XXXXXX" - 1;
        if (!name.starts_with("dynlab-") || name.size() != kNameLength || !is_abandoned(entry->path(), age)) continue;
        std::error_code ignored;
        fs::remove_all(entry->path(), ignored);
        if (!ignored) ++removed;
    }
    return removed;
}

}  // namespace dynlab::inline platform
