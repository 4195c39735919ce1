#include "figures/decimation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <unordered_set>

namespace dynlab::inline figures {
namespace {

constexpr std::size_t kMaxPointCount = 20000;

std::int64_t cell_of(double value, double cell) {
    return static_cast<std::int64_t>(std::floor(std::clamp(value / cell, -1e9, 1e9)));
}

/// Calls use(first, end) for every run of neighbors for which same(i, j) holds; a gap is a separate run.
template <class Same, class Use>
void for_runs(const Trace& trace, Same same, Use use) {
    for (std::size_t first = 0, end; first < trace.size(); first = end) {
        end = first + 1;
        if (!trace[first].gap())
            while (end < trace.size() && !trace[end].gap() && same(trace[first], trace[end])) ++end;
        use(first, end);
    }
}

Trace keep_column_extremes(const Trace& trace, double cell) {
    Trace kept;
    const auto same_column = [cell](const PagePoint& a, const PagePoint& b) {
        return cell_of(a.x, cell) == cell_of(b.x, cell);
    };
    for_runs(trace, same_column, [&](std::size_t first, std::size_t end) {
        const auto by_height = [](const PagePoint& a, const PagePoint& b) { return a.y < b.y; };
        const auto begin = trace.begin() + static_cast<std::ptrdiff_t>(first);
        const auto stop = trace.begin() + static_cast<std::ptrdiff_t>(end);
        auto lowest = begin, highest = begin;
        if (end - first > 2) std::tie(lowest, highest) = std::minmax_element(begin, stop, by_height);
        std::ptrdiff_t order[] = {0, lowest - begin, highest - begin, stop - begin - 1};
        std::sort(std::begin(order), std::end(order));
        const auto distinct = std::unique(std::begin(order), std::end(order));
        for (auto index = std::begin(order); index != distinct; ++index) kept.push_back(begin[*index]);
    });
    return kept;
}

/// Of all segments that join the same two square cells, in the same direction, the first.
Trace keep_new_segments(const Trace& trace, double cell) {
    const auto number = [cell](const PagePoint& p) {
        const auto part = [cell](double value) {
            return static_cast<std::uint64_t>(std::clamp<std::int64_t>(cell_of(value, cell), -32768, 32767) + 32768);
        };
        return part(p.x) << 16 | part(p.y);
    };
    Trace kept;
    std::unordered_set<std::uint64_t> drawn;
    PagePoint pen = {0, std::numeric_limits<double>::quiet_NaN()};  // where the line drawn so far ends
    for (const PagePoint& point : trace) {
        if (!pen.gap() && !point.gap()) {
            const std::uint64_t from = number(pen), to = number(point);
            if (from == to) continue;
            if (!drawn.insert(from << 32 | to).second) {
                if (!kept.back().gap()) kept.push_back({0, std::numeric_limits<double>::quiet_NaN()});
                pen = point;
                continue;
            }
        }
        if (!pen.gap() && kept.back().gap()) kept.push_back(pen);  // goes on after segments drawn already
        kept.push_back(point);
        pen = point;
    }
    return kept;
}

}  // namespace

Trace decimate_line(const Trace& trace, double cell) {
    Trace kept = keep_column_extremes(trace, cell);
    for (; kept.size() > kMaxPointCount && cell < 1; cell *= 2) kept = keep_new_segments(kept, cell);
    return kept;
}

Trace decimate_points(const Trace& trace, double cell) {
    for (Trace kept;; cell *= 2, kept.clear()) {
        std::unordered_set<std::uint64_t> taken;
        for (const PagePoint& point : trace) {
            if (point.gap()) continue;
            const auto column = static_cast<std::uint64_t>(cell_of(point.x, cell)) << 32;
            const auto row = static_cast<std::uint64_t>(cell_of(point.y, cell)) & 0xFFFFFFFFu;
            if (taken.insert(column | row).second) kept.push_back(point);
            if (kept.size() > kMaxPointCount) break;
        }
        if (kept.size() <= kMaxPointCount) return kept;
    }
}

std::pair<Trace, Trace> decimate_band(const Trace& lower, const Trace& upper, double cell) {
    std::pair<Trace, Trace> kept;
    const auto same_column = [cell](const PagePoint& a, const PagePoint& b) {
        return cell_of(a.x, cell) == cell_of(b.x, cell);
    };
    Trace both = lower;  // a gap in either edge is a gap of the band
    for (std::size_t i = 0; i < both.size(); ++i)
        if (upper[i].gap()) both[i] = upper[i];
    for_runs(both, same_column, [&](std::size_t first, std::size_t end) {
        PagePoint low = lower[first], high = upper[first];
        for (std::size_t i = first + 1; i < end; ++i) {
            low.y = std::min(low.y, lower[i].y);
            high.y = std::max(high.y, upper[i].y);
        }
        if (both[first].gap()) low.y = high.y = std::numeric_limits<double>::quiet_NaN();
        kept.first.push_back(low);
        kept.second.push_back(high);
    });
    return kept;
}

}  // namespace dynlab::inline figures
