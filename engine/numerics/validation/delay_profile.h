#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// The smallest mean square simulation error at each delay (s, in rising order) of a structure with one input and one
/// output, all other parameters free, under a start condition: the lower envelope of its solutions, whose values are
/// continuous in the delay. Each delay is fitted by srivc with a start of its own, every fourth by coe as well, and
/// then from the solutions of both neighbors, until none gets lower any more. From a neighbor no model is
/// taken that swings with fewer than four samples a turn or, unless the options ask for it, is unstable. Of the options
/// those of srivc with fixed delays count, but for start and offset, which the condition says. Infinite at a delay for
/// which nothing can be fitted. `threads`: all cores when 0. Throws InvalidArgument for more channels than one.
Vector delay_profile(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                     const Vector& delays, const FitOptions& options, int threads);

}  // namespace dynlab::inline numerics
