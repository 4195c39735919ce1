#pragma once
#include "app/live/channel.h"
#include "app/live/runner_messages.h"

namespace dynlab::inline app {

/// Process that runs the script of a page. It waits for orders and forks before it runs a script, and again after each
/// slow part. The parent keeps the state of the script at that point, the child runs the next parts and reports on its
/// own channel. If the user changes the end of the script, the last process before the change continues from its state.
/// The function does not return. Call it in a process without other threads, because threads do not survive a fork.
[[noreturn]] void serve_runs(Channel orders, RunnerEnvironment world);

}  // namespace dynlab::inline app
