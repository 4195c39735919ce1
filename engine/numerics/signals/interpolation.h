#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Values outside the points: none (a request throws), or the nearest end's value.
enum class Outside { kRefuse, kHold };

/// Linear interpolation of the points (x, y) at `x_new`. `x` increases strictly and has at least two values. Throws
/// InvalidArgument for lengths that differ, for places that are not numbers and, unless the end values are held, for
/// places outside x.front()..x.back(), naming the first one.
Vector interpolate_linearly(const VectorView& x, const VectorView& y, const VectorView& x_new,
                            Outside outside = Outside::kRefuse);

}  // namespace dynlab::inline numerics
