#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::inline platform {

/// Folders of a name drawn at random that carry a lock while their process needs them: it ends with the process, so
/// that the next one can remove what a killed process left (files/temporary_file.h).

/// "dynlab-" and "MACHINE-": what these names begin with on this machine.
std::string prefix_in_use(const std::string& beginning);
/// A new, empty folder PARENT/BEGINNINGXXXXXX with its lock; empty, with errno, where it cannot be made.
std::filesystem::path make_folder_in_use(const std::filesystem::path& parent, const std::string& beginning);
/// The folder is gone or has another name: its lock ends.
void release_folder_in_use(const std::filesystem::path& folder);

enum class Leftovers { kFolders, kFilesAndFolders };
/// Removes what begins so below `parent` and no process uses, of this user. Returns what was removed; what cannot be
/// removed stays.
std::vector<std::filesystem::path> remove_unused(const std::filesystem::path& parent, const std::string& beginning,
                                                 Leftovers leftovers);

}  // namespace dynlab::inline platform
