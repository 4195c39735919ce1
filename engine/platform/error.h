#pragma once
#include <stdexcept>
#include <string>

namespace dynlab::inline platform {

/// A program that dynlab calls is not installed. The message ends with the apt command that installs it. Exit
/// code 3.
class MissingProgram : public std::runtime_error {
  public:
    MissingProgram(const std::string& program, const std::string& package)
        : std::runtime_error(program + " is not installed: sudo apt install " + package) {}
    explicit MissingProgram(const std::string& sentence) : std::runtime_error(sentence) {}  ///< as another dynlab said
};

/// Something outside failed: a file, a folder, a child process. The message names it and says what was tried
/// and why it failed.
class EnvironmentError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The user pressed Ctrl-C. Exit code 130.
class Interrupted : public std::runtime_error {
  public:
    Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace dynlab::inline platform
