#pragma once
#include <optional>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The period of a signal that was wrapped: it stays within -P/2..P/2 or 0..P (P one of the `periods`; noise may lead
/// 5 % beyond), fills 90 % of that, and mostly jumps from near one end to near the other; unwrapping turns these jumps
/// into steps no larger than usual, and its samples predict the next one twice as well. Nothing for other signals.
std::optional<double> wrapped_period(const VectorView& x, const Vector& periods);

}  // namespace dynlab::inline numerics
