#pragma once
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace dynlab::inline numerics {

/// Runs work(0), ..., work(count - 1), in parallel on idle cores, or in sequence if the calls are not `long_enough` for
/// that (some ten microseconds each). A thread that waits here for the last call takes no other work of a surrounding
/// loop in between. Rethrows an exception of one of the calls; other calls may then not run.
template <class Work>
void side_by_side(std::size_t count, const Work& work, bool long_enough = true) {
    if (count == 1 || !long_enough) {
        for (std::size_t i = 0; i < count; ++i) work(i);
        return;
    }
    tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, count, work, tbb::simple_partitioner()); });
}

/// Threads of a task arena for a wish: all cores when it is 0, never more than there are.
inline int thread_count(int requested) {
    return requested > 0 ? std::min(requested, tbb::info::default_concurrency()) : tbb::task_arena::automatic;
}

}  // namespace dynlab::inline numerics
