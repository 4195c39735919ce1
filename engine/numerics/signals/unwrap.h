#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// A signal that is known up to multiples of `period` (an angle), without its jumps: each step between neighbors
/// becomes the smallest one that the period allows, half a period at most. The first sample stays. Exact where the true
/// signal moves by less than half a period from sample to sample. Throws InvalidArgument for a period that is not
/// positive and samples that are not finite.
Vector unwrap(const VectorView& x, double period);

}  // namespace dynlab::inline numerics
