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

/// Runs `work` in a forked copy of this process, so that code which may crash, hang or eat memory on hostile
/// input harms nobody: its string comes back as `output` with exit code 0, the message of an exception it throws
/// as `error_output` with exit code 1, a crash as 128 + signal. The copy has no other open files than its own,
/// its printing goes nowhere, and no destructors or exit handlers run. It has given up starting processes, the network
/// and whatever else refuse_harmful_calls() (platform/confinement.h) refuses. `work` must not wait for other threads,
/// as they do not exist in the copy. Costs a fork (about 1 ms). A process that is confined does the work itself.
/// Throws EnvironmentError and Interrupted like run_child.
ChildResult run_guarded(const std::function<std::string()>& work, const GuardLimits& limits);

/// Whether this process is such a copy for one task: it may give up more, for nothing but `work` is done in it.
bool is_guarded_copy();

}  // namespace dynlab::inline platform
