#include "platform/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <optional>

#include "platform/error.h"
#include "platform/file_blocks.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_write(const fs::path& file, int error_number) {
    std::error_code ignored;
    const fs::path folder = fs::absolute(file, ignored).parent_path();
    throw EnvironmentError("cannot write " + file.filename().string() + ": " + system_reason(error_number) + " (in " +
                           folder.string() + ")");
}

/// Where the bytes must go: behind a symbolic link, so that the link itself survives.
fs::path destination(const fs::path& file) {
    std::error_code error;
    if (!fs::is_symlink(file, error)) return file;
    const fs::path target = fs::weakly_canonical(file, error);
    if (error) fail_to_write(file, error.value());
    return target;
}

/// Status of what stands at `file` now; nothing when there is none.
std::optional<struct stat> present_status(const fs::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) == 0) return status;
    if (errno != ENOENT) fail_to_write(file, errno);
    return std::nullopt;
}

/// A new file beside the destination that replaces it on commit and is removed when commit() is not reached.
class ReplacementFile {
  public:
    explicit ReplacementFile(const fs::path& file) : file_(destination(file)) {
        const auto present = present_status(file_);
        if (present && S_ISDIR(present->st_mode)) fail_to_write(file, EISDIR);
        if (present && !S_ISREG(present->st_mode)) {  // a device or a pipe cannot be replaced: write into it
            fd_ = FileDescriptor(::open(file_.c_str(), O_WRONLY | O_CLOEXEC));
        } else {
            create_beside();
            if (fd_ && present) ::fchmod(fd_.get(), present->st_mode & 07777);
        }
        if (!fd_) fail_to_write(file, errno);
    }
    ~ReplacementFile() {
        if (!temporary_.empty()) ::unlink(temporary_.c_str());
    }
    ReplacementFile(const ReplacementFile&) = delete;
    ReplacementFile& operator=(const ReplacementFile&) = delete;

    void append(std::string_view bytes) {
        if (!write_all(fd_.get(), bytes.data(), bytes.size())) fail_to_write(file_, errno);
    }

    void commit() {
        if (!temporary_.empty() && retry_interrupted([&] { return ::fsync(fd_.get()); }) != 0) {
            fail_to_write(file_, errno);
        }
        if (fd_.close() != 0) fail_to_write(file_, errno);
        if (temporary_.empty()) return;
        if (::rename(temporary_.c_str(), file_.c_str()) != 0) fail_to_write(file_, errno);
        temporary_.clear();
    }

  private:
    /// Not mkstemp: its files are private, while a new file here gets the permissions the user's umask grants.
    void create_beside() {
        static std::atomic<unsigned> counter{0};
        do {
            temporary_ = file_.parent_path() /
                         fmt::format(".{}.{}-{}", file_.filename().string().substr(0, 200), ::getpid(), counter++);
            fd_ = FileDescriptor(::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        } while (!fd_ && errno == EEXIST);
        if (!fd_) temporary_.clear();
    }

    fs::path file_, temporary_;
    FileDescriptor fd_;
};

void sync_content(const fs::path& file) {
    const FileDescriptor fd = open_to_read(file);
    if (retry_interrupted([&] { return ::fsync(fd.get()); }) != 0) fail_to_write(file, errno);
}

void refuse_unfinished(const fs::path& from) {
    std::error_code error;
    if (!fs::is_regular_file(from, error)) fail_to_read(from, error ? error.value() : EINVAL);
}

}  // namespace

void write_file_atomically(const fs::path& file, std::string_view content) {
    ReplacementFile replacement(file);
    replacement.append(content);
    replacement.commit();
}

void place_file_atomically(const fs::path& from, const fs::path& to) {
    refuse_unfinished(from);
    const fs::path target = destination(to);
    const auto present = present_status(target);
    if (!present || S_ISREG(present->st_mode)) {
        sync_content(from);
        if (::rename(from.c_str(), target.c_str()) == 0) return;
        if (errno != EXDEV) fail_to_write(to, errno);
    }
    ReplacementFile replacement(target);
    for_each_block(from, [&](std::string_view block) { replacement.append(block); });
    replacement.commit();
    std::error_code ignored;  // the destination is whole; a left-over source harms nobody
    fs::remove(from, ignored);
}

std::string read_file(const fs::path& file) {
    std::string content;
    std::error_code ignored;
    const std::uintmax_t size = fs::file_size(file, ignored);
    if (!ignored) content.reserve(size);
    for_each_block(file, [&](std::string_view block) { content.append(block); });
    return content;
}

}  // namespace dynlab::inline platform
