#include "platform/file_blocks.h"

#include <fcntl.h>
#include <unistd.h>

#include <string>

#include "platform/error.h"

namespace dynlab::inline platform {

void fail_to_read(const std::filesystem::path& file, int error_number) {
    throw EnvironmentError("cannot read {}: {}", file.string(), system_reason(error_number));
}

FileDescriptor open_to_read(const std::filesystem::path& file) {
    FileDescriptor fd(retry_interrupted([&] { return ::open(file.c_str(), O_RDONLY | O_CLOEXEC); }));
    if (!fd) fail_to_read(file, errno);
    return fd;
}

void for_each_block(const std::filesystem::path& file, const std::function<void(std::string_view)>& take) {
    const FileDescriptor fd = open_to_read(file);
    std::string block(1u << 18, '\0');
    for (;;) {
        const ssize_t count = retry_interrupted([&] { return ::read(fd.get(), block.data(), block.size()); });
        if (count < 0) fail_to_read(file, errno);
        if (count == 0) return;
        take(std::string_view(block.data(), static_cast<std::size_t>(count)));
    }
}

}  // namespace dynlab::inline platform
