#include "platform/files/plain_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "platform/files/replacement_file.h"

namespace dynlab::inline platform {
namespace {

/// Its size, where it is a plain file.
std::optional<std::uintmax_t> plain_size(const FileDescriptor& file) {
    struct stat status {};
    if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    return static_cast<std::uintmax_t>(status.st_size);
}

constexpr int kPlainly = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY;

FileDescriptor open_plainly(const std::filesystem::path& file) {
    return FileDescriptor(retry_interrupted([&] { return ::open(file.c_str(), O_RDONLY | kPlainly); }));
}

/// So many bytes; fewer where the file was cut meanwhile, or cannot be read on.
std::string first_bytes(const FileDescriptor& file, std::uintmax_t count) {
    std::string bytes(count, '\0');
    std::size_t done = 0;
    for (ssize_t more = 1; more > 0 && done < bytes.size();
         done += static_cast<std::size_t>(std::max<ssize_t>(0, more)))
        more = retry_interrupted([&] { return ::read(file.get(), bytes.data() + done, bytes.size() - done); });
    bytes.resize(done);
    return bytes;
}

}  // namespace

std::optional<std::string> read_plain_file(const std::filesystem::path& file, std::uintmax_t most) {
    const FileDescriptor opened = open_plainly(file);
    const auto size = plain_size(opened);
    return size && *size <= most ? std::optional(first_bytes(opened, *size)) : std::nullopt;
}

std::string start_of_plain_file(const std::filesystem::path& file, std::uintmax_t most) {
    const FileDescriptor opened = open_plainly(file);
    return first_bytes(opened, std::min(most, plain_size(opened).value_or(0)));
}

FileDescriptor open_plain_file(const std::filesystem::path& file, int flags) {
    FileDescriptor opened(
        retry_interrupted([&] { return ::open(file.c_str(), O_WRONLY | O_CREAT | kPlainly | flags, 0600); }));
    return plain_size(opened) ? std::move(opened) : FileDescriptor();
}

void write_plain_file(const std::filesystem::path& file, std::string_view content) {
    ReplacementFile replacement = ReplacementFile::of_owner(file);
    replacement.append(content);
    replacement.commit();
}

}  // namespace dynlab::inline platform
