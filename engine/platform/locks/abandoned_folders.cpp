#include "platform/locks/abandoned_folders.h"

#include <fcntl.h>

#include <cstdlib>
#include <string_view>

#include "platform/files/temporary_file.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDrawn = "XXXXXX";

}  // namespace

fs::path parent_of_temporary_folders() {
    const char* const parent = std::getenv("TMPDIR");
    return parent && *parent ? parent : "/tmp";
}

std::string pattern_of_temporary_folders() {
    return "dynlab-" + machine_in_names() + "-" + std::string(kDrawn);
}

std::vector<fs::path> remove_abandoned_folders() {
    const std::string pattern = pattern_of_temporary_folders();
    const std::string beginning = pattern.substr(0, pattern.size() - kDrawn.size());
    std::vector<fs::path> removed;
    std::error_code error;
    for (fs::directory_iterator entry(parent_of_temporary_folders(), error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(beginning) || name.size() != pattern.size()) continue;
        const FileDescriptor folder(::open(entry->path().c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
        if (!folder || !lock_leftover(folder.get())) continue;
        std::error_code ignored;
        fs::remove_all(entry->path(), ignored);
        if (!ignored) removed.push_back(entry->path());
    }
    return removed;
}

}  // namespace dynlab::inline platform
