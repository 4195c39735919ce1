#pragma once
#include <cstddef>
#include <functional>

namespace dynlab::inline course {

/// Does work(0) ... work(count - 1) on all cores, one after the other on each; `progress` hears of it in the calling
/// thread. When one throws, no further one is begun and the first exception is thrown on.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t done, std::size_t total)>& progress = {});

}  // namespace dynlab::inline course
