#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The signal with `margin` more samples at either end: its point reflection in the end samples, 2 x(1) - x(1 + k)
/// before and 2 x(N) - x(N - k) after it, reflected again if the margin is longer than the signal. Levels and slopes
/// are continuous. Needs at least one sample.
Vector point_reflected(const VectorView& x, Index margin);

}  // namespace dynlab::inline numerics
