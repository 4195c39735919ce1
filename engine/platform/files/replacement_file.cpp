#include "platform/files/replacement_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <utility>

#include "platform/error.h"
#include "platform/file_blocks.h"
#include "platform/files/temporary_file.h"
#include "platform/written_files.h"

namespace dynlab::inline platform {

namespace fs = std::filesystem;

void fail_to_write(const fs::path& file, int error_number) {
    std::error_code ignored;
    const fs::path folder = fs::absolute(file, ignored).parent_path();
    throw EnvironmentError("cannot write {}: {} (in {})", file.filename().string(), system_reason(error_number),
                           folder.string());
}

fs::path destination_of(const fs::path& file) {
    std::error_code error;
    if (!fs::is_symlink(file, error)) return file;
    const fs::path target = fs::weakly_canonical(file, error);
    if (error) fail_to_write(file, error.value());
    return target;
}

std::optional<struct stat> present_status(const fs::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) == 0) return status;
    if (errno != ENOENT) fail_to_write(file, errno);
    return std::nullopt;
}

ReplacementFile::ReplacementFile(const fs::path& file, const fs::path& made_in) : file_(destination_of(file)) {
    const auto present = present_status(file_);
    if (present && S_ISDIR(present->st_mode)) fail_to_write(file, EISDIR);
    if (present && !S_ISREG(present->st_mode)) {  // a device or a pipe cannot be replaced: write into it
        fd_ = FileDescriptor(::open(file_.c_str(), O_WRONLY | O_CLOEXEC));
    } else {
        create_in(made_in.empty() ? file_.parent_path() : made_in, 0666);
        if (fd_ && present) ::fchmod(fd_.get(), present->st_mode & 07777);
    }
    if (!fd_) fail_to_write(file, errno);
}

ReplacementFile::ReplacementFile(ReplacementFile&& other) noexcept
    : file_(std::move(other.file_)),
      temporary_(std::exchange(other.temporary_, fs::path())),
      fd_(std::move(other.fd_)),
      ends_(std::move(other.ends_)) {}

ReplacementFile ReplacementFile::of_owner(const fs::path& file) {
    ReplacementFile made;
    made.file_ = file;
    made.create_in(file.parent_path(), 0600);
    if (!made.fd_) fail_to_write(file, errno);
    return made;
}

ReplacementFile::~ReplacementFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void ReplacementFile::append(std::string_view bytes) {
    if (!write_all(fd_.get(), bytes.data(), bytes.size())) fail_to_write(file_, errno);
}

void ReplacementFile::begin_to_sync() const {
    ::sync_file_range(fd_.get(), 0, 0, SYNC_FILE_RANGE_WRITE);
}

void ReplacementFile::commit() {
    if (!temporary_.empty()) {  // renamed while it is open: its lock shows that it is in use
        if (retry_interrupted([&] { return ::fsync(fd_.get()); }) != 0) fail_to_write(file_, errno);
        note_replacement(file_, temporary_);
        if (::rename(temporary_.c_str(), file_.c_str()) == 0) {
            temporary_.clear();
        } else {
            if (errno != EXDEV) fail_to_write(file_, errno);
            replace_by_copy(temporary_, file_);
        }
    }
    if (fd_.close() != 0) fail_to_write(file_, errno);
}

void replace_by_copy(const fs::path& from, const fs::path& to) {
    ReplacementFile replacement(to);
    for_each_block(from, [&](std::string_view block) { replacement.append(block); });
    replacement.commit();
}

void ReplacementFile::create_in(const fs::path& folder, mode_t mode) {
    TemporaryFile made = make_temporary_file(folder, file_.filename().string(), mode);
    fd_ = std::move(made.file);
    if (!fd_) return;
    temporary_ = std::move(made.path);
    ends_ = EndsWithProgram(temporary_);
}

}  // namespace dynlab::inline platform
