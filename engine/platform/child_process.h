#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "platform/time_limits.h"

namespace dynlab::inline platform {

struct ChildOptions {
    std::vector<std::string> command;  ///< program (looked up in PATH) and its arguments; no shell
    std::filesystem::path folder;      ///< working folder; the current one when empty
    std::vector<std::pair<std::string, std::string>> environment;  ///< added to (replacing in) the inherited one
    std::string input;                                             ///< given on standard input, then closed
    bool input_later = false;                                      ///< give_input() gives it, once it is known
    /// Wall clock, from the start or the input given later; the whole process group is killed after it.
    std::optional<std::chrono::milliseconds> timeout;
    /// Of the program and all that it starts together; what is counted does not depend on the machine's load.
    std::optional<std::chrono::milliseconds> processor_time;
    std::optional<std::uint64_t> memory_bytes;  ///< address-space limit of the child
    std::optional<std::uint64_t> file_bytes;    ///< of the largest file the child may write; SIGXFSZ ends it
    std::uint64_t output_bytes = 64u << 20;     ///< more output than this ends the child
    std::function<bool()> give_up = {};         ///< asked twenty times a second: true ends the child
    bool heeds_interrupt = true;  ///< false: Ctrl-C is deferred, because the work must be complete or undone
};

struct ChildResult {
    int exit_code = -1;                  ///< 128 + signal when ended by a signal
    bool timed_out = false,              ///< by either limit of time
        processor_time_used_up = false,  ///< by that of processor time
        output_exceeded = false, given_up = false;
    std::string output, error_output;

    /// The one of time that ended it.
    TimeLimit time_limit() const {
        if (!timed_out) return TimeLimit::kNone;
        return processor_time_used_up ? TimeLimit::kProcessor : TimeLimit::kClock;
    }
};

/// What execve takes: pointers to the texts, and a null pointer behind them.
std::vector<char*> pointers_to(std::vector<std::string>& texts);

/// Runs a program in a separate process group and waits. Processes that the program leaves in that group are killed
/// when it ends. Ctrl-C (see InterruptScope) kills the group and throws Interrupted. Throws MissingProgram (with
/// `package`, the Debian package that contains it) if the program is not found, EnvironmentError if it cannot be
/// started.
ChildResult run_child(const ChildOptions& options, const std::string& package);

/// The same without waiting: start, do other work, then wait(). Output beyond a pipe's worth (about 1 MB) holds
/// the child until wait(), and a timeout is enforced there. The thread that starts the child must outlive it.
class ChildProcess {
  public:
    ChildProcess(const ChildOptions& options, const std::string& package);
    ~ChildProcess();  ///< kills the group when not waited for
    ChildProcess(ChildProcess&&) noexcept;
    ChildProcess& operator=(ChildProcess&&) noexcept;
    /// The complete standard input of a child that was started with `input_later`; the child must read it before it
    /// writes more than a pipe holds. A child that has ended ignores the input; wait() reports the end.
    void give_input(const std::string& input);
    bool ended() const;  ///< without a kill: wait() returns at once
    int id() const;      ///< of the process, before wait()
    ChildResult wait();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace dynlab::inline platform
