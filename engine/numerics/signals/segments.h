#pragma once
#include <utility>
#include <vector>

#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Samples first..last of an experiment, 1-based, inclusive.
struct Segment {
    Index first, last;
};

/// Returns these segments of the data (one experiment), each as a separate experiment that keeps its times, in the
/// given order. Throws InvalidArgument for no segment, for an empty segment or one that reaches outside the data, and
/// for two that overlap.
IdData keep_segments(const IdData& data, const std::vector<Segment>& kept);

/// What is left when these stretches, which may overlap, are cut out. Leftovers shorter than `min_length` samples go
/// too. Throws like keep_segments, and when nothing is left.
IdData discard_segments(const IdData& data, const std::vector<Segment>& discarded, Index min_length = 2);

/// In order, overlapping and touching ones joined.
std::vector<Segment> joined(std::vector<Segment> segments);

}  // namespace dynlab::inline numerics
