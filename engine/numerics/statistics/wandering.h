#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Whether a signal wanders, like a random walk or a straight line: n (1 - r) < 14 for the correlation r of neighbors
/// among its means over n = 60 parts (Sargan and Bhargava 1983, true for 97 % of random walks). Noise with a memory of
/// less than a thirtieth of the data, such as AR(0.9) in 300 samples, has a larger value. False for fewer than 240
/// samples.
bool wanders(const VectorView& x);

}  // namespace dynlab::inline numerics
