#include "platform/time_limits.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <vector>

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr auto kBetweenLooks = std::chrono::milliseconds(1);

/// What the kernel counts of a process and of the children it waited for, in clock ticks.
long long ticks_of(pid_t process) {
    std::ifstream stream(fmt::format("/proc/{}/stat", process));
    std::string stat;
    std::getline(stream, stat, '\0');              // nothing of a process that ends meanwhile
    const std::size_t name_end = stat.rfind(')');  // the name may hold anything
    if (name_end == std::string::npos) return 0;
    long long own = 0, system = 0, children = 0, children_system = 0;
    std::sscanf(stat.c_str() + name_end + 1, " %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lld %lld %lld %lld", &own,
                &system, &children, &children_system);
    return own + system + children + children_system;
}

/// A thread's children are its process's.
void append_children(pid_t process, std::vector<pid_t>& children) {
    std::error_code gone;
    for (fs::directory_iterator thread(fmt::format("/proc/{}/task", process), gone), end; !gone && thread != end;
         thread.increment(gone)) {
        std::ifstream stream(thread->path() / "children");
        for (pid_t child = 0; stream >> child;) children.push_back(child);
    }
}

}  // namespace

double TimeLimits::seconds(TimeLimit reached) const {
    return std::chrono::duration<double>(reached == TimeLimit::kProcessor ? processor : clock()).count();
}

std::chrono::nanoseconds processor_time() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// A parent is read before its children: one that ends meanwhile is missed this time, but none is counted twice.
std::chrono::milliseconds processor_time_of_tree(pid_t root) {
    long long ticks = 0;
    std::vector<pid_t> waiting = {root};
    while (!waiting.empty()) {
        const pid_t process = waiting.back();
        waiting.pop_back();
        ticks += ticks_of(process);
        append_children(process, waiting);
    }
    return std::chrono::milliseconds(ticks * 1000 / ::sysconf(_SC_CLK_TCK));
}

TimeBudget::TimeBudget(const TimeLimits& limits)
    : max_processor_time_(processor_time() + limits.processor), latest_(Clock::now() + limits.clock()) {}

TimeLimit TimeBudget::reached() {
    if (const TimeLimit before = reached_; before != TimeLimit::kNone) return before;
    const auto now = Clock::now();
    if (now.time_since_epoch().count() < next_look_) return TimeLimit::kNone;
    next_look_ = (now + kBetweenLooks).time_since_epoch().count();
    if (now > latest_)
        reached_ = TimeLimit::kClock;
    else if (processor_time() > max_processor_time_)
        reached_ = TimeLimit::kProcessor;
    return reached_;
}

}  // namespace dynlab::inline platform
