#pragma once
#include <sys/types.h>

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "platform/files/ends_with_program.h"
#include "platform/system_call.h"

namespace dynlab::inline figures {

/// A running gnuplot. A thread collects its messages, so that neither side ever waits for the other to read. It runs in
/// a separate process group and reads no start-up files.
class GnuplotProcess {
  public:
    GnuplotProcess();  ///< throws MissingProgram, or EnvironmentError when it cannot be started
    ~GnuplotProcess();
    GnuplotProcess(const GnuplotProcess&) = delete;
    GnuplotProcess& operator=(const GnuplotProcess&) = delete;

    void end();               ///< at once; nothing that is under way is completed
    std::FILE* take_input();  ///< where commands go; the caller's to close

    /// The command that makes gnuplot report that it has done everything before it.
    static std::string report_command(unsigned number);
    /// Waits for that report; returns what gnuplot complained of since the report before. Nothing when gnuplot ended
    /// instead or is stuck for two minutes. Throws Interrupted.
    std::optional<std::string> wait_for_report(unsigned number);
    /// What gnuplot, which ends, complained of and wait_for_report() has not taken: all of it, unless its end takes
    /// longer than a second.
    std::string last_complaints();

  private:
    void start(const std::string& program);
    void collect();

    pid_t pid_ = -1;
    EndsWithProgram ends_;
    FileDescriptor commands_, complaints_;
    std::thread reader_;
    std::mutex mutex_;
    std::condition_variable heard_;
    std::string text_;    ///< guarded by mutex_
    bool ended_ = false;  ///< guarded by mutex_
};

}  // namespace dynlab::inline figures
