#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// dx/dt = A x + [1; 0; ..] u with a companion matrix (linalg/polynomial.h), alone or with a second system of the same
/// matrix behind it, whose first state is driven by one state of the first.
struct CompanionPair {
    Matrix one;  ///< of one system, n x n
    bool twice = false;
    Index driving = 0;  ///< the state of the first system that drives the second
    double drive = 0;   ///< the entry by which it does
};

/// Throws InvalidArgument for other matrices.
CompanionPair companion_pair(const Matrix& A);

}  // namespace dynlab::inline numerics
