#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// dx/dt = A x + B u, y = C x + D u with one input.
struct SingleInputSystem {
    Matrix A;
    Vector B;
    Matrix C;
    Vector D;
};

/// y = B(p)/A(p) u and its derivatives with respect to every coefficient as the outputs of one system of order 2n, the
/// cascade of 1/A with itself: n + m + 3 outputs
///     y = B/A u,   dy/da_i = -p^(n-i) B/A^2 u,   dy/db_j = p^(m-j)/A u,   -p B/A u (the derivative by a delay).
/// A is monic of degree n >= 1, 0 <= m <= n. With m = n the derivative by the delay leaves out the impulses of -b_0 pu;
/// with m = n - 1 it jumps where a held input does. These are also the instruments of SRIVC.
SingleInputSystem sensitivity_system(const VectorView& num, const VectorView& den);

/// The order-2n matrix of z and w with A(p) z = v, A(p) w = p^r z; the state holds the n-1-st ... 0-th derivatives of
/// z, then of w.
Matrix cascade_matrix(const VectorView& den, Index r);

}  // namespace dynlab::inline numerics
