#pragma once
#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string_view>

#include "platform/files/ends_with_program.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {

/// What atomic_file.h is made of: a new file beside the destination that replaces it on commit() and is removed when
/// that is not reached (temporary_file.h says what becomes of it where the process is killed). A device or a pipe
/// cannot be replaced and is written into. All throw EnvironmentError.
class ReplacementFile {
  public:
    /// `made_in`: the folder of the new file. Default: that of `file`. On another file system the content is copied
    /// once more on commit().
    explicit ReplacementFile(const std::filesystem::path& file, const std::filesystem::path& made_in = {});
    /// A file that only its owner can read. It replaces an existing file or symbolic link at `file` (see plain_file.h).
    static ReplacementFile of_owner(const std::filesystem::path& file);
    ~ReplacementFile();
    ReplacementFile(ReplacementFile&& other) noexcept;
    ReplacementFile(const ReplacementFile&) = delete;
    ReplacementFile& operator=(const ReplacementFile&) = delete;

    void append(std::string_view bytes);
    /// The bytes set out for the disk; commit() waits for them.
    void begin_to_sync() const;
    void commit();

  private:
    ReplacementFile() = default;
    void create_in(const std::filesystem::path& folder, mode_t mode);

    std::filesystem::path file_, temporary_;
    FileDescriptor fd_;
    EndsWithProgram ends_;
};

/// Replaces `to` with a copy of `from`.
void replace_by_copy(const std::filesystem::path& from, const std::filesystem::path& to);

[[noreturn]] void fail_to_write(const std::filesystem::path& file, int error_number);
/// Behind a symbolic link, so that the link itself survives.
std::filesystem::path destination_of(const std::filesystem::path& file);
/// Status of the file, folder or link at `file`; empty if there is none.
std::optional<struct stat> present_status(const std::filesystem::path& file);

}  // namespace dynlab::inline platform
