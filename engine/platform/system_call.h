#pragma once
#include <cerrno>
#include <string>

namespace dynlab::inline platform {

/// A file descriptor that closes itself.
class FileDescriptor {
  public:
    explicit FileDescriptor(int fd = -1) : fd_(fd) {}
    ~FileDescriptor() { close(); }
    FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.release()) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept;
    int get() const { return fd_; }
    explicit operator bool() const { return fd_ >= 0; }
    int release();
    int close();  ///< what close(2) returned: 0 or -1 with errno

  private:
    int fd_;
};

/// The system's reason for `error_number`, in lower case: "no space left on device".
std::string system_reason(int error_number);

/// Repeats a system call that a signal interrupted.
template <class Call>
auto retry_interrupted(Call call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

/// Writes all bytes; false with errno set when that fails.
bool write_all(int fd, const char* bytes, std::size_t count);

}  // namespace dynlab::inline platform
