#pragma once
#include <stdexcept>
#include <string>

#include "base/error.h"

namespace dynlab::inline platform {

/// A program that dynlab calls is not installed. The message ends with the apt command that installs it. Exit
/// code 3.
class MissingProgram : public ErrorOf<std::runtime_error> {
  public:
    MissingProgram(const std::string& program, const std::string& package)
        : ErrorOf("{} is not installed. Install it with: sudo apt install {}", program, package) {}
    explicit MissingProgram(const Message& message) : ErrorOf(message) {}  ///< as another dynlab reported
};

/// Something outside failed: a file, a folder, a child process. The message names it and says what was tried
/// and why it failed.
class EnvironmentError : public ErrorOf<std::runtime_error> {
  public:
    using ErrorOf::ErrorOf;
};

/// The user pressed Ctrl-C. Exit code 130.
class Interrupted : public ErrorOf<std::runtime_error> {
  public:
    Interrupted() : ErrorOf("interrupted") {}
};

}  // namespace dynlab::inline platform
