#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Replaces the square matrix A by D^-1 A D and returns the diagonal of D: powers of two, chosen so that the norms
/// of each row and column of A nearly agree. No rounding error is made; eigenvalues and functions of badly scaled
/// matrices (companion matrices above all) become accurate. (Parlett and Reinsch 1969.)
Vector balance(Eigen::Ref<Matrix> A);

}  // namespace dynlab::inline numerics
