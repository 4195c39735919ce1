#pragma once
#include <algorithm>
#include <cstdint>

namespace dynlab::inline course {

/// What being late by `late` seconds costs, in percent: `per_day` for each day or part of a day, `max_percent` at most.
inline double late_percent(double per_day, double max_percent, std::int64_t late) {
    constexpr std::int64_t kDay = 86400;
    if (late <= 0) return 0;
    return std::min(max_percent, per_day * static_cast<double>((late + kDay - 1) / kDay));
}

}  // namespace dynlab::inline course
