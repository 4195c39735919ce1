#pragma once
#include <chrono>
#include <filesystem>

namespace dynlab::inline platform {

/// Removes from $TMPDIR this user's temporary folders (TemporaryFolder) whose process was killed before it could: those
/// that nobody holds a lock on and that are so old at least, as their maker may be about to lock them. Returns how
/// many. What cannot be removed stays.
int remove_abandoned_folders(std::chrono::seconds age = std::chrono::hours(1));

/// Where temporary folders are made: $TMPDIR, or /tmp.
std::filesystem::path parent_of_temporary_folders();

}  // namespace dynlab::inline platform
