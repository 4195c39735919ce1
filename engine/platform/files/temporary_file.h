#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "platform/system_call.h"

namespace dynlab::inline platform {

/// Files and folders that are removed when their work is done, but stay if a process is killed (kill -9, power
/// failure). Each has a lock (flock) that ends with its process, and the machine's name in its file name. The next
/// process on that machine removes those that no process has locked. So neither a reused process number nor a process
/// in another PID namespace is mistaken for the maker, and files of other machines on a shared folder stay. If a file
/// system has no locks, everything stays.

/// A new, empty file ".NAME.dynlab-MACHINE-PID-N" for what is to become NAME, locked while `file` is open. The first
/// one that a process makes in a folder removes the leftovers there; later ones do not list the folder again.
struct TemporaryFile {
    std::filesystem::path path;
    FileDescriptor file;  ///< for writing; none, with errno, where the file cannot be made
};
TemporaryFile make_temporary_file(const std::filesystem::path& folder, const std::string& name, mode_t mode);

/// Removes temporary files of killed processes of this user on this machine from a folder, not from those below it.
/// Returns the removed files. Files that cannot be removed stay without an error.
std::vector<std::filesystem::path> remove_leftover_files(const std::filesystem::path& folder);

/// Takes the lock that shows that the temporary file or folder at `path` is in use, without waiting: any process that
/// can read a folder can lock a new file before its maker does. Returns false if another process has the lock, or if a
/// process that cleans up has removed the file: make another one then.
bool lock_as_in_use(int descriptor, const std::filesystem::path& path);
/// Whether this user owns it and no process uses it. If so, the lock is taken until the descriptor is closed.
bool lock_leftover(int descriptor);
/// This machine's name as part of file names: at most 24 letters, digits, - and _.
const std::string& machine_in_names();
/// The same for any machine. Names that do not fit, such as long names of cluster nodes, keep their first letters and
/// get a part of their SHA-256, so that no two machines share a name.
std::string machine_in_names(const std::string& machine);

}  // namespace dynlab::inline platform
