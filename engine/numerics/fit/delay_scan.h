#pragma once
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

// Where a joint search with free delays begins: on a curve of the loss over the delay.

/// The smallest mean square simulation error found at each delay, and where a joint search begins.
struct DelayScan {
    Vector delays, losses;       ///< s in rising order, and the mean square errors
    std::vector<Vector> starts;  ///< theta with the delay, around the lowest minima of the curve, best first
    double largest = 0;          ///< s; delays up to here were tried
};

/// The largest delay worth looking at first: where the correlation of the input with later output has its peak, and a
/// bit more; at least a few samples, at most a quarter of the shortest record. The quarter itself for inputs that
/// change three times or less, whose correlation tells nothing of the delay.
double likely_largest_delay(const IdData& data);

/// theta of fixed delays with the delays put in their places.
Vector with_delays(const TransferStructure& free, const TransferStructure& at, const Vector& theta);

/// The structure with its delays fixed where their search begins.
TransferStructure with_fixed_delays(TransferStructure structure);

/// The structure with its delays fixed at those of theta.
TransferStructure with_delays_of(const TransferStructure& structure, const Vector& theta);

/// Loss over the delay of every channel in turn (the others as found so far), zero state and no offset, in at most
/// delay_count steps of at least one mean sampling time, and no more than two samples apart near the lowest valleys.
/// Every delay is fitted from its neighbors' solutions on both sides, some from filtered starts too, so that the curve
/// is the lower envelope of what was found. Unless the options give the largest delay, the range grows while the curve
/// is lowest at its end, up to a quarter of the shortest record. Of longer records the first 50,000 samples are looked
/// at, of those sampled irregularly 1,500 where they tell of the whole: the inputs move as much as later, and the
/// delays are shorter than a quarter of them. The curve is the last channel's.
DelayScan scan_delays(const IdData& data, const TransferStructure& structure, const FitOptions& options);

}  // namespace dynlab::inline numerics
