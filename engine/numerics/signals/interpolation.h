#pragma once
#include "numerics/linalg/types.h"

namespace dynlab {

/// Values at `x_new` on the straight lines between the points (x, y). `x` increases strictly and has at least two
/// values; throws InvalidArgument for lengths that differ and for places outside x.front()..x.back(), naming the first
/// one.
Vector interpolate_linearly(const VectorView& x, const VectorView& y, const VectorView& x_new);

}  // namespace dynlab
