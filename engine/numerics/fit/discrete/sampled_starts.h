#pragma once
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

// Starts for models of slowly sampled data. If a pole turns by a radian or more from sample to sample, filters of the
// sampled signals show little of the behavior between the samples, and searches that begin with them miss the best
// model. A difference equation needs no filter: its poles are converted to continuous time (the indirect method).

/// theta of the structure (one input, one output, regular sampling), with its delay where it is free, best first, at
/// most three: the poles those of difference equations z^-l B(z)/F(z) that were fitted to the output error
/// (fit/discrete/sriv_iteration.h), numerator, initial values and offset by least squares, for a free delay at four
/// points of each of the sampling intervals that a difference equation with room for several delays has chosen. Nothing
/// where no difference equation has an error clearly smaller than `found`, a fit of this structure.
std::vector<Vector> sampled_starts(const IdData& data, const TransferStructure& structure, const Fit& found,
                                   const FitOptions& options);

}  // namespace dynlab::inline numerics
