#pragma once
#include <sys/types.h>
#include <termios.h>

#include <string>
#include <vector>

#include "support/program.h"

namespace dynlab::test {

inline constexpr const char *kControlC = "\x03", *kControlD = "\x04";

/// The program on a separate pseudo-terminal, as a student sees it.
class Terminal {
  public:
    explicit Terminal(const Workbench& bench, const std::vector<std::string>& arguments = {});
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    void type(const std::string& text) const;
    void enter(const std::string& line) const { type(line + "\r"); }

    /// Reads until `expected` appears; what came before it and it are returned and forgotten.
    std::string until(const std::string& expected);
    std::string until_prompt() { return until("dynlab> "); }

    bool modes_are_as_before() const;
    int wait_for_end();  ///< exit code, 128 + signal
    pid_t child() const { return child_; }

  private:
    bool read_more();  ///< false at the end, or when nothing came for long

    int terminal_ = -1;
    pid_t child_ = -1;
    termios modes_before_{};
    std::string seen_;
};

}  // namespace dynlab::test
