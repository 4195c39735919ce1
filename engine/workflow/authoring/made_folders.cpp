#include "workflow/authoring/made_folders.h"

#include "platform/cache.h"

namespace dynlab::inline workflow {
namespace {

std::string entry_of_folder(const std::filesystem::path& folder) {
    const std::filesystem::path place =
        std::filesystem::weakly_canonical(std::filesystem::absolute(folder.empty() ? "." : folder));
    return EntryName("made_folders", "1").add(place.string()).text();
}

}  // namespace

void note_made_folder(const std::filesystem::path& folder) {
    Cache().save_entry(entry_of_folder(folder), "made");
}

bool was_made_here(const std::filesystem::path& folder) {
    return Cache().load_entry(entry_of_folder(folder)).has_value();
}

}  // namespace dynlab::inline workflow
