#pragma once
#include "app/live/channel.h"
#include "app/live/runner_messages.h"

namespace dynlab::inline app {

/// The process that runs a page's script. It waits for orders; to obey one it splits, and so it does again behind each
/// part that took time: the process that stays keeps the state in which the script was there, and the one that goes on
/// tells of its own line. Whoever changes the end of a script has the last process before it go on anew. Nothing of
/// this returns. Threads do not outlive a split: call it in a process that has none.
[[noreturn]] void serve_runs(Channel orders, RunnerWorld world);

}  // namespace dynlab::inline app
