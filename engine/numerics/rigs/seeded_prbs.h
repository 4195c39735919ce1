#pragma once
#include "numerics/linalg/types.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

/// A pseudo-random binary sequence as an experimenter with another seed would apply it: one period of prbs(stages,
/// hold) that begins at a random bit, runs forwards or backwards and has a random sign (three uniform draws). Every one
/// has the same spectrum; no two seeds give the same order of bits, few exceptions apart.
Vector seeded_prbs(int stages, int hold, double low, double high, RandomStream& random);

}  // namespace dynlab::inline numerics
