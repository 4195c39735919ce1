#include "app/live/folder_watch.h"

#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>

#include "platform/error.h"

namespace dynlab::inline app {

namespace fs = std::filesystem;

fs::path place_of(const fs::path& file) {
    std::error_code failure;
    const fs::path found = fs::weakly_canonical(fs::absolute(file), failure);
    return failure ? file : found;
}

FolderWatch::FolderWatch() : events_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    if (!events_) throw EnvironmentError("cannot watch folders for changes: {}", system_reason(errno));
}

void FolderWatch::add(const fs::path& folder) {
    constexpr std::uint32_t kChanges = IN_CREATE | IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_MODIFY;
    const int watch = ::inotify_add_watch(events_.get(), folder.c_str(), kChanges | IN_ONLYDIR);
    if (watch < 0)
        throw EnvironmentError("cannot watch the folder {} for changes: {}", folder.string(), system_reason(errno));
    folders_[watch] = folder;
}

void FolderWatch::add_around(const fs::path& file) {
    fs::path folder = fs::absolute(file).parent_path();
    while (!fs::is_directory(folder) && folder.has_relative_path()) folder = folder.parent_path();
    add(folder);
}

bool concerns(const fs::path& changed, const fs::path& file) {
    return std::mismatch(changed.begin(), changed.end(), file.begin(), file.end()).first == changed.end();
}

std::set<fs::path> FolderWatch::changes() {
    std::set<fs::path> changed;
    alignas(inotify_event) char block[1 << 14];
    for (ssize_t count; (count = retry_interrupted([&] { return ::read(events_.get(), block, sizeof block); })) > 0;) {
        for (ssize_t at = 0; at < count;) {
            const auto& event = *reinterpret_cast<const inotify_event*>(block + at);
            at += static_cast<ssize_t>(sizeof event + event.len);
            const auto folder = folders_.find(event.wd);
            if (folder != folders_.end() && event.len > 0) changed.insert(folder->second / event.name);
        }
    }
    return changed;
}

}  // namespace dynlab::inline app
