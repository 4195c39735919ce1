#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

class TransferFunction;

/// dx/dt = A x + B u, y = C x + D u (Ts = 0), or x(k+1) = A x(k) + B u(k) with Ts > 0.
struct StateSpace {
    Matrix A, B, C, D;  ///< n x n, n x nu, ny x n, ny x nu
    double Ts = 0;      ///< seconds, 0 for continuous time

    StateSpace() = default;
    /// Throws InvalidArgument naming the matrix whose size does not fit.
    StateSpace(Matrix A, Matrix B, Matrix C, Matrix D, double Ts = 0);
    Index order() const { return A.rows(); }
};

/// Controllable canonical form of the delay-free part; state i is s^(n-i)/den u. Needs a proper G.
StateSpace to_state_space(const TransferFunction& G);
/// Transfer function from input `input` to output `output` (0-based), by eigenvalues of A and of the zero
/// pencil.
TransferFunction to_transfer_function(const StateSpace& system, Index output = 0, Index input = 0);

}  // namespace dynlab::inline numerics
