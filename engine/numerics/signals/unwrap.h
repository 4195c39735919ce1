#pragma once
#include <optional>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// A signal that is known up to multiples of `period` (an angle), without its jumps: each step between neighbors
/// becomes the smallest one that the period allows, half a period at most. The first sample stays. Exact where the true
/// signal moves by less than half a period from sample to sample. Throws InvalidArgument for a period that is not
/// positive and samples that are not finite.
Vector unwrap(const VectorView& x, double period);

/// The period of a signal that was wrapped: it stays within -P/2..P/2 or 0..P (P one of the `periods`; noise may lead
/// 5 % beyond), fills 90 % of that, and mostly jumps from near one end to near the other; unwrapping turns these jumps
/// into steps no larger than usual, and its samples predict the next one twice as well. Nothing for other signals.
std::optional<double> wrapped_period(const VectorView& x, const Vector& periods);

}  // namespace dynlab::inline numerics
