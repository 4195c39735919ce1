#include "app/live/permissions.h"

#include <algorithm>

#include "platform/atomic_file.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

std::string entry_of(const char* kind, const fs::path& place) {
    return EntryName(kind, "1").add(place.string()).text();
}

}  // namespace

Permissions::Permissions(const fs::path& script)
    : script_(fs::weakly_canonical(fs::absolute(script))), folder_(script_.parent_path()) {
    granted_ = was_granted();
}

bool Permissions::was_granted() const {
    const fs::path lessons = fs::weakly_canonical(shared_folder() / "lessons");
    const bool is_lesson =
        std::mismatch(lessons.begin(), lessons.end(), folder_.begin(), folder_.end()).first == lessons.end();
    if (is_lesson || cache_.load_entry(entry_of("allowed_folders", folder_))) return true;
    const auto text = cache_.load_entry(entry_of("allowed_scripts", script_));
    return text && fs::is_regular_file(script_) && *text == digest_of(read_text(script_)).hex();
}

void Permissions::grant() {
    granted_ = true;
    cache_.save_entry(entry_of("allowed_folders", folder_), "allowed");
}

void Permissions::grant_script(std::string_view text) {
    granted_ = true;
    cache_.save_entry(entry_of("allowed_scripts", script_), digest_of(text).hex());
}

}  // namespace dynlab::inline app
