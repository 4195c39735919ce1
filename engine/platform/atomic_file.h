#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline platform {

/// Writes `content` to a temporary file in the folder of `file`, syncs it and renames it: `file` is either complete or
/// unchanged. Throws EnvironmentError that names the file and the system's reason (no such folder, not writable, disk
/// full).
void write_file_atomically(const std::filesystem::path& file, std::string_view content);
/// Moves or copies a finished file to its destination with the same promise, across file systems too.
void place_file_atomically(const std::filesystem::path& from, const std::filesystem::path& to);

struct NewFile {
    std::filesystem::path file;
    std::string content;
};
/// Writes several files in their order, each one atomically: a file appears only after all files before it. All files
/// are synced together, which takes little longer than syncing one. `made_in`: folder of the temporary files; files on
/// another file system are copied. Default: the folder of each file. Throws EnvironmentError as write_file_atomically
/// does.
void write_files_atomically(const std::vector<NewFile>& files, const std::filesystem::path& made_in = {});

std::string read_file(const std::filesystem::path& file);  ///< throws EnvironmentError
/// The content of a text file, without the byte order mark that some editors put before UTF-8: it is not part of the
/// first line. Throws EnvironmentError as read_file does.
std::string read_text(const std::filesystem::path& file);
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace dynlab::inline platform
