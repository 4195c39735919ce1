#include "platform/locks/in_use.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string_view>

#include "platform/files/temporary_file.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDrawn = "XXXXXX";

struct Locks {
    std::mutex mutex;
    std::map<fs::path, FileDescriptor> held;
};

Locks& locks() {
    static Locks* const all = new Locks;  // outlives every other object
    return *all;
}

}  // namespace

std::string prefix_in_use(const std::string& beginning) {
    return beginning + machine_in_names() + "-";
}

fs::path make_folder_in_use(const fs::path& parent, const std::string& beginning) {
    for (;;) {
        std::string path = parent / (beginning + std::string(kDrawn));
        if (!::mkdtemp(path.data())) return {};
        FileDescriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (!folder && errno != ENOENT) {
            const int reason = errno;
            ::rmdir(path.c_str());
            errno = reason;
            return {};
        }
        if (!folder || !lock_as_in_use(folder.get(), path)) {  // taken for a leftover, before it had its lock
            ::rmdir(path.c_str());
            continue;
        }
        const std::lock_guard lock(locks().mutex);
        locks().held.insert_or_assign(path, std::move(folder));
        return path;
    }
}

void release_folder_in_use(const fs::path& folder) {
    const std::lock_guard lock(locks().mutex);
    locks().held.erase(folder);
}

std::vector<fs::path> remove_unused(const fs::path& parent, const std::string& beginning, Leftovers leftovers) {
    const int kind = leftovers == Leftovers::kFolders ? O_DIRECTORY : O_NONBLOCK;
    std::vector<fs::path> removed;
    std::error_code error;
    for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(beginning) || name.size() != beginning.size() + kDrawn.size()) continue;
        const FileDescriptor file(::open(entry->path().c_str(), O_RDONLY | kind | O_NOFOLLOW | O_CLOEXEC));
        if (!file || !lock_leftover(file.get())) continue;
        std::error_code ignored;
        fs::remove_all(entry->path(), ignored);
        if (!ignored) removed.push_back(entry->path());
    }
    return removed;
}

}  // namespace dynlab::inline platform
