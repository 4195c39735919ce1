#pragma once
#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "platform/child_process.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {

struct Pipe {
    Pipe();  ///< throws EnvironmentError
    FileDescriptor read_end, write_end;
};

/// The first actions of a freshly forked child (async-signal-safe): a separate group, death with its parent, default
/// signals. Returns false if the parent no longer exists.
bool become_group_leader(pid_t parent);

/// fork(2) of a copy that dies with this process. 0 in the copy; below 0, with errno, where there is none.
pid_t fork_bound_copy();

/// Starts a program as the leader of a separate group, without a copy of this process's memory (vfork). The program is
/// killed when the calling thread ends for any reason. `streams`: its standard input, output and error output. Returns
/// its id; below 0, with errno, if it cannot be started.
pid_t start_bound_program(const std::string& program, std::vector<std::string> arguments,
                          std::vector<std::string> environment, const std::array<int, 3>& streams);

void limit_memory(std::uint64_t bytes);  ///< address space of this process from now on
/// Of this process and of each that it starts, rounded up to seconds; SIGXCPU ends it, and a lower limit stays.
void limit_processor_time(std::chrono::milliseconds max_time);
void limit_files(std::uint64_t bytes);  ///< the largest file it writes from now on; a lower limit stays

/// The parent's side of a forked child that leads its own process group and writes into two pipes.
class ProcessGroup {
  public:
    struct Limits {
        std::optional<std::chrono::milliseconds> timeout;         ///< from construction, or the last start_clock
        std::optional<std::chrono::milliseconds> processor_time;  ///< of the leader and all its descendants together
        std::uint64_t output_bytes;
        std::function<bool()> give_up = {};
        bool heeds_interrupt = true;
    };
    ProcessGroup(pid_t leader, FileDescriptor output, FileDescriptor error_output, const Limits& limits);
    ~ProcessGroup();  ///< kills the group when wait() has not reaped the leader
    ProcessGroup(const ProcessGroup&) = delete;
    ProcessGroup& operator=(const ProcessGroup&) = delete;

    void start_clock();  ///< the timeout counts from now on
    /// Collects output until the leader exits or is killed at a limit. Throws Interrupted if the group heeds
    /// interrupts.
    ChildResult wait();
    bool leader_exited() const;
    pid_t leader() const { return leader_; }

  private:
    void collect_until_exit();
    bool processor_time_is_used_up();
    void collect(FileDescriptor& stream, std::string& text);
    int milliseconds_to_poll() const;
    void kill_and_reap();

    pid_t leader_;
    FileDescriptor output_, error_output_, leader_exit_;
    std::optional<std::chrono::milliseconds> timeout_, processor_time_;
    std::optional<std::chrono::steady_clock::time_point> deadline_;
    std::chrono::steady_clock::time_point next_look_{};  ///< at the processor time
    std::uint64_t output_bytes_;
    std::function<bool()> give_up_;
    bool heeds_interrupt_;
    ChildResult result_;
};

}  // namespace dynlab::inline platform
