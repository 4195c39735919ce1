#pragma once
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

// Starts for models of slowly sampled records. Where a pole turns by a radian and more from sample to sample, filters
// of the sampled signals tell little of what happens between the samples, and searches that begin with them miss the
// best model. A difference equation needs no filter: its poles lead back to continuous time (the indirect way).

/// Whether the errors of a fit of one input and one output follow the input of up to 20 samples before (and its delay,
/// the last 200 lags of these): the sum over these lags that is chi-squared distributed for white errors which do not
/// is far beyond chance.
bool errors_follow_input(const IdData& data, const Fit& fit);

/// Whether they do so and change from sample to sample as what such a pole leaves does: the squares of the errors'
/// differences are a tenth or more of their own (for a sine of w radians a sample they are 2 (1 - cos w)). Slow errors,
/// such as those of a linear model of a nonlinear system, are nothing that a difference equation would mend.
bool fast_errors_follow_input(const IdData& data, const Fit& fit);

/// Whether the errors follow themselves: their autocorrelations of 20 lags (Box and Pierce 1970) are far beyond chance.
bool errors_are_coloured(const IdData& data, const Fit& fit);

/// theta of the structure (one input, one output, regular sampling), with its delay where it is free, best first, at
/// most three: the poles those of difference equations z^-l B(z)/F(z) that were fitted to the output error
/// (fit/discrete/sriv_iteration.h), numerator, initial values and offset by least squares, for a free delay at four
/// points of each of the sampling intervals that a difference equation with room for several delays has chosen. Nothing
/// where no difference equation has an error clearly smaller than `found`, a fit of this structure.
std::vector<Vector> sampled_starts(const IdData& data, const TransferStructure& structure, const Fit& found,
                                   const FitOptions& options);

}  // namespace dynlab::inline numerics
