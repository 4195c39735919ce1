#pragma once
#include <optional>
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

/// The largest delay worth trying at first: slightly beyond the peak of the correlation of the input with later output;
/// at least a few samples, at most a quarter of the shortest experiment. For inputs that change three times or less,
/// whose correlation does not show the delay, it is the quarter.
double likely_largest_delay(const IdData& data);

/// The lag (s) beyond `largest` at which the output is correlated with the input by more than chance, and more clearly
/// than at any shorter lag. No value for irregularly sampled data and for inputs that change three times or less. Lags
/// up to three quarters of the shortest experiment are tested; of longer data the first 50,000 samples.
std::optional<double> later_response(const IdData& data, Index output, Index input, double largest);

/// Warns of a later response if the fit explains little of the output with a delay below `largest`.
void warn_of_later_response(Fit& fit, const IdData& data, Index output, Index input, double delay, double largest);
/// For all channels of a fit with free delays, found in the range that the options give.
void warn_of_later_responses(Fit& fit, const IdData& data, const FitOptions& options);

/// theta of fixed delays with the delays put in their places.
Vector with_delays(const TransferStructure& free, const TransferStructure& at, const Vector& theta);

/// The structure with its delays fixed where their search begins.
TransferStructure with_fixed_delays(TransferStructure structure);

/// The structure with its delays fixed at those of theta.
TransferStructure with_delays_of(const TransferStructure& structure, const Vector& theta);

/// Loss over the delay of every channel in turn (the others at their current estimates), with zero state and no offset.
/// The grid has at most delay_count steps of at least one mean sampling time, with at most two samples between points
/// near the lowest valleys. Every delay is fitted from its neighbors' solutions on both sides, some also from filtered
/// starts, so that the curve is the lower envelope of all solutions found. Unless the options give the largest delay,
/// the range grows while the curve is lowest at its end, up to a quarter of the shortest experiment. Of longer data the
/// scan uses the first 50,000 samples. Of irregularly sampled data it uses 1,500 samples if these are representative:
/// the inputs vary as much as later, and the delays are shorter than a quarter of these samples. The curve is the last
/// channel's.
DelayScan scan_delays(const IdData& data, const TransferStructure& structure, const FitOptions& options);

}  // namespace dynlab::inline numerics
