#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline platform {

/// Writes `content` to a temporary file beside `file`, syncs, then renames: `file` appears whole or stays as
/// it was. Throws EnvironmentError that names the file and the system's reason (no such folder, not writable,
/// disk full).
void write_file_atomically(const std::filesystem::path& file, std::string_view content);
/// Moves or copies a finished file to its destination with the same promise, across file systems too.
void place_file_atomically(const std::filesystem::path& from, const std::filesystem::path& to);

struct NewFile {
    std::filesystem::path file;
    std::string content;
};
/// As write_file_atomically for each, in their order: each appears whole or not at all, and none before those that
/// stand before it. They wait for the disk together, which takes little longer than for one. `made_in`: the folder of
/// the temporary files; those on another file system are copied. Default: beside each file.
void write_files_atomically(const std::vector<NewFile>& files, const std::filesystem::path& made_in = {});

std::string read_file(const std::filesystem::path& file);  ///< throws EnvironmentError
/// The content of a text file, without the byte order mark that some editors put before UTF-8: it is not part of the
/// first line. Throws EnvironmentError as read_file does.
std::string read_text(const std::filesystem::path& file);
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace dynlab::inline platform
