#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "platform/child_process.h"
#include "platform/time_limits.h"

namespace dynlab::inline platform {

/// Limits of run_guarded; memory counts on top of what this process has mapped already.
struct GuardLimits {
    TimeLimits time{std::chrono::milliseconds(3000), 20};
    std::uint64_t memory_bytes = 2ull << 30, output_bytes = 2ull << 30;
    bool one_task = true;  ///< nothing else is done in the copy, which may confine itself to what the task needs
};

/// Runs `work` in a forked copy of this process, so that code which may crash, hang or use much memory on hostile input
/// does no harm. `output` is the returned string, with exit code 0. An exception gives its message as `error_output`,
/// with exit code 1; a crash gives exit code 128 + signal. The copy has no open files except those that it opens, its
/// output is discarded, and no destructors or exit handlers run. It cannot start processes, use the network or make any
/// other call that refuse_harmful_calls() (platform/confinement.h) refuses. `work` must not wait for other threads, as
/// they do not exist in the copy. The call costs a fork (about 1 ms). A process that is already confined does the work
/// itself. Throws EnvironmentError and Interrupted like run_child.
ChildResult run_guarded(const std::function<std::string()>& work, const GuardLimits& limits);

/// Whether this process is such a copy for one task: it may give up more, for nothing but `work` is done in it.
bool is_guarded_copy();

}  // namespace dynlab::inline platform
