#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// The smallest mean square simulation error at each delay (s, in rising order) of a structure with one input and one
/// output, all other parameters free, under a start condition: the lower envelope of its solutions, whose values are
/// continuous in the delay. srivc fits each delay from a separate start, coe also fits every fourth delay, and then
/// each delay is fitted from the solutions of both neighbors until none improves. A neighbor's model is not used if it
/// oscillates with fewer than four samples a period or, unless the options allow it, is unstable. The options of srivc
/// with fixed delays are used, except start and offset, which the condition determines. Infinite at a delay for which
/// no model can be fitted. `threads`: all cores if 0. Throws InvalidArgument for more than one channel.
Vector delay_profile(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                     const Vector& delays, const FitOptions& options, int threads);

}  // namespace dynlab::inline numerics
