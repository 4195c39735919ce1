#pragma once
#include <filesystem>

namespace dynlab::inline workflow {

/// Folders that `dynlab new` made on this computer, for this user: kept in the cache, where a folder that is not known
/// any more counts as another's.
void note_made_folder(const std::filesystem::path& folder);
bool was_made_here(const std::filesystem::path& folder);

}  // namespace dynlab::inline workflow
