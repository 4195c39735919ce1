#include "numerics/signals/segments.h"

#include <algorithm>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

void check_segments(const std::string& caller, const IdData& data, const std::vector<Segment>& segments) {
    if (data.experiments.size() != 1)
        throw InvalidArgument(
            "{}: the data must have one experiment, but they have {}; select one with data:experiment(k)", caller,
            data.experiments.size());
    if (segments.empty()) throw InvalidArgument("{}: specify at least one range {first, last}", caller);
    const Index count = data.sample_count();
    for (const Segment& segment : segments)
        if (segment.first < 1 || segment.last > count || segment.first > segment.last)
            throw InvalidArgument(
                "{}: {} to {} is not a valid range; the data have samples 1 to {}. The first sample must not be after "
                "the last sample",
                caller, segment.first, segment.last, count);
}

/// A sample in two segments would count twice.
void check_apart(std::vector<Segment> kept) {
    std::sort(kept.begin(), kept.end(), [](const Segment& a, const Segment& b) { return a.first < b.first; });
    for (std::size_t i = 1; i < kept.size(); ++i)
        if (kept[i].first <= kept[i - 1].last)
            throw InvalidArgument("keep: the ranges {} to {} and {} to {} overlap, so some samples would count twice",
                                  kept[i - 1].first, kept[i - 1].last, kept[i].first, kept[i].last);
}

}  // namespace

IdData keep_segments(const IdData& data, const std::vector<Segment>& kept) {
    check_segments("keep", data, kept);
    check_apart(kept);
    std::vector<IdData> parts;
    for (const auto& [first, last] : kept) {
        parts.push_back(data.range(first, last));
        parts.back().experiments.front().name = "samples " + std::to_string(first) + " to " + std::to_string(last);
    }
    return IdData::merge(parts);
}

std::vector<Segment> joined(std::vector<Segment> segments) {
    std::sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) { return a.first < b.first; });
    std::vector<Segment> result;
    for (const Segment& segment : segments) {
        if (!result.empty() && segment.first <= result.back().last + 1)
            result.back().last = std::max(result.back().last, segment.last);
        else
            result.push_back(segment);
    }
    return result;
}

IdData discard_segments(const IdData& data, const std::vector<Segment>& discarded, Index min_length) {
    check_segments("discard", data, discarded);
    std::vector<Segment> kept;
    Index next = 1;
    const auto keep_until = [&](Index last) {
        if (last - next + 1 >= std::max<Index>(min_length, 1)) kept.push_back({next, last});
    };
    for (const Segment& segment : joined(discarded)) {
        keep_until(segment.first - 1);
        next = segment.last + 1;
    }
    keep_until(data.sample_count());
    if (kept.empty())
        throw InvalidArgument("discard: no range of at least {} samples would remain. Specify smaller ranges",
                              min_length);
    return keep_segments(data, kept);
}

}  // namespace dynlab::inline numerics
