#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// M'M for M = [J e], J of N rows and d columns, e of length N: (d + 1) x (d + 1). For many rows and few columns, which
/// the general product is slow at: half of the sums, from rows in the processor's cache.
Matrix tall_gram(const MatrixView& J, const VectorView& e);

}  // namespace dynlab::inline numerics
