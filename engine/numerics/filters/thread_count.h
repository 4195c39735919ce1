#pragma once
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace dynlab::inline numerics {

/// Threads of a task arena for a wish: all cores when it is 0, never more than there are.
inline int thread_count(int wanted) {
    return wanted > 0 ? std::min(wanted, tbb::info::default_concurrency()) : tbb::task_arena::automatic;
}

}  // namespace dynlab::inline numerics
