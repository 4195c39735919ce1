#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Whether a signal wanders, as a random walk or a straight line does: n (1 - r) < 14 for the correlation r of
/// neighbors among its means over n = 60 parts (Sargan and Bhargava 1983, of a random walk in 97 %). Noise that forgets
/// within a thirtieth of the record, such as AR(0.9) in 300 samples, lies above. False for fewer than 240 samples.
bool wanders(const VectorView& x);

}  // namespace dynlab::inline numerics
