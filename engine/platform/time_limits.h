#pragma once
#include <sys/types.h>

#include <atomic>
#include <chrono>

namespace dynlab::inline platform {

enum class TimeLimit { kNone, kProcessor, kClock };

/// What work may take. Processor time is counted for all its threads and processes together and does not depend on
/// other work on the machine; the clock's limit, a multiple of it, ends work that waits.
struct TimeLimits {
    std::chrono::milliseconds processor{10000};
    int clock_multiple = 5;

    std::chrono::milliseconds clock() const { return clock_multiple * processor; }
    /// For the messages about work that reached a limit.
    double seconds(TimeLimit reached) const;
};

std::chrono::nanoseconds processor_time();  ///< of this process, all threads

/// Of a process, of all that descend from it and run, and of all that these waited for; zero where it is gone.
std::chrono::milliseconds processor_time_of_tree(pid_t root);

/// The limits of what this process does from now on. Threads may share one.
class TimeBudget {
  public:
    explicit TimeBudget(const TimeLimits& limits);
    /// The limit that was reached first, from then on. Cheap: the processor's clock, a system call, is read once a
    /// millisecond at most.
    TimeLimit reached();

  private:
    using Clock = std::chrono::steady_clock;

    std::chrono::nanoseconds max_processor_time_;  ///< as processor_time() counts
    Clock::time_point latest_;
    std::atomic<Clock::rep> next_look_{0};
    std::atomic<TimeLimit> reached_{TimeLimit::kNone};
};

}  // namespace dynlab::inline platform
