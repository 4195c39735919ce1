#pragma once
#include "numerics/linalg/types.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

/// A rig's sensor: white normal noise of standard deviation `noise_std`, then rounding to whole multiples of
/// `resolution` (none when 0).
Vector measure(const Vector& truth, double noise_std, double resolution, RandomStream& random);
/// The same with the noise's numbers, of standard deviation one, drawn before.
Vector measure(const Vector& truth, double noise_std, double resolution, const Vector& normals);

}  // namespace dynlab::inline numerics
