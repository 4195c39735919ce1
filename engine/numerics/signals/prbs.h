#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// One full period of the pseudo-random binary sequence of a shift register with `stages` stages (3 to 18), each
/// bit held for `hold` samples: (2^stages - 1) hold samples. Fibonacci register of maximal length, all ones at the
/// start, its last stage the output; a one gives `high`. Throws InvalidArgument for other stages or hold < 1.
Vector prbs(int stages, int hold, double low = -1, double high = 1);

}  // namespace dynlab::inline numerics
