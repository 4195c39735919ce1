#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::inline platform {

/// Removes temporary folders (TemporaryFolder) of this user on this machine from $TMPDIR whose process was killed, so
/// that no process holds their lock (files/temporary_file.h). Returns the removed folders. Folders that cannot be
/// removed stay.
std::vector<std::filesystem::path> remove_abandoned_folders();

/// Where temporary folders are made: $TMPDIR, or /tmp.
std::filesystem::path parent_of_temporary_folders();
/// What the name of a temporary folder begins with, before six letters and digits: "dynlab-MACHINE-".
std::string beginning_of_temporary_folders();

}  // namespace dynlab::inline platform
