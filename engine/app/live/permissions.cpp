#include "app/live/permissions.h"

#include <algorithm>

#include "platform/program_lookup.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

std::string entry_of(const char* kind, const fs::path& place) {
    return EntryName(kind, "1").add(place.string()).text();
}

}  // namespace

Permissions::Permissions(const fs::path& script)
    : script_(fs::weakly_canonical(fs::absolute(script))), folder_(script_.parent_path()) {}

bool Permissions::granted() const {
    const fs::path lessons = fs::weakly_canonical(shared_folder() / "lessons");
    const bool is_lesson =
        std::mismatch(lessons.begin(), lessons.end(), folder_.begin(), folder_.end()).first == lessons.end();
    return is_lesson || cache_.recall(entry_of("allowed_folders", folder_)).has_value() ||
           cache_.recall(entry_of("allowed_scripts", script_)).has_value();
}

void Permissions::grant() const {
    cache_.remember(entry_of("allowed_folders", folder_), "allowed");
}

void Permissions::grant_script() const {
    cache_.remember(entry_of("allowed_scripts", script_), "allowed");
}

}  // namespace dynlab::inline app
