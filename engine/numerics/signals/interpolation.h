#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// What stands outside the points: nothing (asking for it throws), or the nearest end's value.
enum class Outside { kRefuse, kHold };

/// Values at `x_new` on the straight lines between the points (x, y). `x` increases strictly and has at least two
/// values; throws InvalidArgument for lengths that differ, for places that are no numbers and, unless the end values
/// are held, for places outside x.front()..x.back(), naming the first one.
Vector interpolate_linearly(const VectorView& x, const VectorView& y, const VectorView& x_new,
                            Outside outside = Outside::kRefuse);

}  // namespace dynlab::inline numerics
