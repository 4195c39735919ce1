#pragma once
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

// Start values for iterations and searches of continuous-time transfer functions without a user-defined start.

/// The part of the data on which start values are searched: the beginning, so that it starts from rest like all data.
IdData beginning_of(const IdData& data, Index max_samples);

/// The data of one input with this signal in each experiment as the output.
IdData single_channel(const IdData& data, const std::vector<Vector>& outputs, Index input);

/// lssvf's theta with poles mirrored, for any structure. If an output's channels have separate denominators, a common
/// denominator of their joint order is fitted first, and each channel then to its share of that model's output. NaN if
/// the equations cannot be solved.
Vector lssvf_start(const IdData& data, const TransferStructure& structure, double lambda, Hold hold_y);

/// Which cutoff frequencies are followed: all, or those whose first estimate has a smaller loss than its neighbors'
/// and no more than three times the smallest loss found, which nearly always lead to the same in a third of the time:
/// enough for SRIVC's passes, behind which a search follows where they fail.
enum class CutoffTrials { kValleys, kAll };

/// Returns a start without initial values: lssvf_start for cutoff frequencies over the band that the data can show,
/// followed by a few passes of iterate_srivc; the theta of smallest loss. Throws InvalidArgument if no loss is finite.
Vector best_cutoff_start(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                         CutoffTrials trials = CutoffTrials::kAll);

/// theta where a search begins: options.lambda's first estimate or the best of several cutoff frequencies.
Vector first_estimate(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                      CutoffTrials trials = CutoffTrials::kAll);

/// A start from rest for fixed delays: the first estimate at options.lambda or at the best of several cutoff
/// frequencies, on the beginning of long data.
Vector start_from_rest(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                       CutoffTrials trials = CutoffTrials::kAll);

}  // namespace dynlab::inline numerics
