#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// exp(A) of a square matrix: balancing, then scaling and squaring with Pade approximants (Higham 2005). Every
/// entry is accurate to a few units of rounding when the balanced A is not far from normal. Throws InvalidArgument
/// when A is not square or not finite.
Matrix matrix_exponential(const MatrixView& A);

/// What one step of length h does to dx/dt = A x + B u when u runs straight from a value a to a value b:
/// x(h) = F x(0) + H0 a + H1 b; a constant input (zero-order hold) is H0 + H1 = G.
struct StepMatrices {
    Matrix F, G, H0, H1;  ///< n x n, then three n x m
};

/// Exact, by one matrix exponential of a block matrix (Van Loan 1978); B may have any number of columns. h >= 0.
StepMatrices exact_step(const MatrixView& A, const MatrixView& B, double h);

}  // namespace dynlab::inline numerics
