#include "platform/files/replacement_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <utility>

#include "platform/error.h"

namespace dynlab::inline platform {

namespace fs = std::filesystem;

void fail_to_write(const fs::path& file, int error_number) {
    std::error_code ignored;
    const fs::path folder = fs::absolute(file, ignored).parent_path();
    throw EnvironmentError("cannot write " + file.filename().string() + ": " + system_reason(error_number) + " (in " +
                           folder.string() + ")");
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

ReplacementFile::ReplacementFile(const fs::path& file) : file_(destination_of(file)) {
    const auto present = present_status(file_);
    if (present && S_ISDIR(present->st_mode)) fail_to_write(file, EISDIR);
    if (present && !S_ISREG(present->st_mode)) {  // a device or a pipe cannot be replaced: write into it
        fd_ = FileDescriptor(::open(file_.c_str(), O_WRONLY | O_CLOEXEC));
    } else {
        create_beside(0666);
        if (fd_ && present) ::fchmod(fd_.get(), present->st_mode & 07777);
    }
    if (!fd_) fail_to_write(file, errno);
}

ReplacementFile::ReplacementFile(ReplacementFile&& other) noexcept
    : file_(std::move(other.file_)),
      temporary_(std::exchange(other.temporary_, fs::path())),
      fd_(std::move(other.fd_)) {}

ReplacementFile ReplacementFile::of_owner(const fs::path& file) {
    ReplacementFile made;
    made.file_ = file;
    made.create_beside(0600);
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
    if (!temporary_.empty() && retry_interrupted([&] { return ::fsync(fd_.get()); }) != 0) {
        fail_to_write(file_, errno);
    }
    if (fd_.close() != 0) fail_to_write(file_, errno);
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), file_.c_str()) != 0) fail_to_write(file_, errno);
    temporary_.clear();
}

/// Not mkstemp: its files are private, while a new file here gets the permissions the user's umask grants.
void ReplacementFile::create_beside(mode_t mode) {
    static std::atomic<unsigned> counter{0};
    do {
        temporary_ = file_.parent_path() /
                     fmt::format(".{}.{}-{}", file_.filename().string().substr(0, 200), ::getpid(), counter++);
        fd_ = FileDescriptor(::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    } while (!fd_ && errno == EEXIST);
    if (!fd_) temporary_.clear();
}

}  // namespace dynlab::inline platform
