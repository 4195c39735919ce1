#include "platform/system_call.h"

#include <unistd.h>

#include <cctype>
#include <cstring>
#include <utility>

namespace dynlab::inline platform {

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
    if (this != &other) {
        close();
        fd_ = other.release();
    }
    return *this;
}

int FileDescriptor::release() {
    return std::exchange(fd_, -1);
}

int FileDescriptor::close() {
    return fd_ < 0 ? 0 : ::close(release());
}

std::string system_reason(int error_number) {
    std::string reason = std::strerror(error_number);
    // "No space left" becomes "no space left"; "RPC ..." and the like stay.
    if (reason.size() > 1 && std::islower(static_cast<unsigned char>(reason[1]))) {
        reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
    }
    return reason;
}

bool write_all(int fd, const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t written = retry_interrupted([&] { return ::write(fd, bytes, count); });
        if (written < 0) return false;
        bytes += written;
        count -= static_cast<std::size_t>(written);
    }
    return true;
}

}  // namespace dynlab::inline platform
