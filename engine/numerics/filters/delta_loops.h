#pragma once
#include <algorithm>

#include "numerics/filters/delta_products.h"
#include "numerics/filters/lanes.h"

namespace dynlab::inline numerics {

// The loops of delta_products: segments of the data run side by side in lanes, and the compiler knows the orders of
// both chains.

constexpr int kDeltaLanes = Lanes::kWidth;

// Only the part of the following that orders n1 and n2 use is set to zero: setting all of it would take much of the
// time for short data.

/// What both chains have come to, in all lanes.
struct DeltaState {
    Lanes::Part first[kMaxDeltaOrder], second[kMaxDeltaOrder];

    void set_zero(int n1, int n2) {
        std::fill_n(first, n1, Lanes::Part{});
        std::fill_n(second, n2, Lanes::Part{});
    }
};
/// The products that are summed while filtering.
struct DeltaSums {
    Lanes::Part first[kMaxDeltaOrder + 1], both[2 * kMaxDeltaOrder + 1], second[kMaxDeltaOrder + 1];

    void set_zero(int n1, int n2) {
        std::fill_n(first, n1 + 1, Lanes::Part{});
        std::fill_n(both, n1 + n2 + 1, Lanes::Part{});
        std::fill_n(second, n2 + 1, Lanes::Part{});
    }
};
/// Samples k = 0, 1, .. of the segments, lane i's at samples[k + i stride].
struct SegmentSamples {
    const double* samples;
    Index stride;
};

/// Of the products X_j W_(s-j), the j of the one that is summed.
constexpr int summed_row(int n1, int n2, int s) {
    return (std::max(0, s - n2) + std::min(n1, s)) / 2;
}

using SumLoop = void (*)(const DeltaChain&, const DeltaChain&, const SegmentSamples& v, const SegmentSamples& w,
                         Index steps, DeltaState& state, DeltaSums& sums);

/// Filters only, and lets `free` move without a signal beside it: each alone would wait for itself.
using FilterLoop = void (*)(const DeltaChain&, const DeltaChain&, const SegmentSamples& v, const SegmentSamples& w,
                            Index steps, DeltaState& state, DeltaState& free);

/// The loops for two orders: filtering alone, and with sums.
struct DeltaLoops {
    FilterLoop filter = nullptr;
    SumLoop sum = nullptr;
    RequestedProducts summed;  ///< all that are wanted, if not more
};

/// Null pointers for orders that have no loop, or none that sums what is wanted.
DeltaLoops delta_loops(int order1, int order2, RequestedProducts requested);

}  // namespace dynlab::inline numerics
