#pragma once
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace dynlab::inline numerics {

/// work(0), ..., work(count - 1), at the same time where there are idle cores; one after the other where they are not
/// `long_enough` for that (some ten microseconds each). Whoever waits here for the last one takes up none of a
/// surrounding loop's work in between. Throws what one of them throws; others may then be left out.
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
