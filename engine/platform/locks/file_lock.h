#pragma once
#include <filesystem>

#include "platform/system_call.h"

namespace dynlab::inline platform {

/// A lock that one process at a time can have, on a file that is made where there is none; it goes with the process,
/// however that ends.
class FileLock {
  public:
    /// Throws EnvironmentError where the file cannot be made.
    explicit FileLock(const std::filesystem::path& file);
    bool held() const { return held_; }  ///< false: another process has it

  private:
    FileDescriptor file_;
    bool held_ = false;
};

}  // namespace dynlab::inline platform
