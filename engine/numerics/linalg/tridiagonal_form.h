#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// A = Q T Q' for a symmetric A, T tridiagonal: its diagonal, what stands beside it, and Q'b. A quarter of the work of
/// the eigenvalues.
struct TridiagonalForm {
    Vector diagonal, beside, rotated;
};
TridiagonalForm tridiagonal_form(const MatrixView& A, const VectorView& b);

}  // namespace dynlab::inline numerics
