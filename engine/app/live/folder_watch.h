#pragma once
#include <filesystem>
#include <map>
#include <set>

#include "platform/system_call.h"

namespace dynlab::inline app {

/// Reports when files in folders change (inotify on the folders, so that files which editors replace, and files that
/// reappear, are seen). It does not watch parent folders or subfolders.
class FolderWatch {
  public:
    FolderWatch();  ///< throws EnvironmentError
    /// Throws EnvironmentError for a folder that cannot be watched. A folder again is no harm.
    void add(const std::filesystem::path& folder);
    /// The folder of a file or, where it is not there yet, the nearest above it that is.
    void add_around(const std::filesystem::path& file);
    int descriptor() const { return events_.get(); }  ///< readable when something has changed
    /// The files that have changed, as folder/name with the folders as they were given; does not wait.
    std::set<std::filesystem::path> changes();

  private:
    FileDescriptor events_;
    std::map<int, std::filesystem::path> folders_;
};

/// Whether a change of `changed` is one of `file`: the file itself, or a folder in which it lies.
bool concerns(const std::filesystem::path& changed, const std::filesystem::path& file);

/// A file's place with links followed; as it is named where it has gone meanwhile, as files beside the watched ones do.
std::filesystem::path place_of(const std::filesystem::path& file);

}  // namespace dynlab::inline app
