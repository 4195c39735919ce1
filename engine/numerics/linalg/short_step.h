#pragma once
#include <optional>

#include "numerics/linalg/state_matrix.h"

namespace dynlab::inline numerics {

/// A short step of length h of dx/dt = A x + B u with n states, for u that runs straight from a to b:
///     x(h) = x + E x + (W - R) B a + R B b.
template <int capacity>
struct ShortStep {
    StateMatrix<capacity> E;     ///< exp(A h) - I, with all digits however short the step
    StateMatrix<capacity> W, R;  ///< h phi_1(hA), h phi_2(hA)
};

/// By Taylor's series of phi_2(Z) = sum_k Z^k/(k+2)!, Z = hA (Higham 2008, section 10.7.4):
///     phi_1 = I + Z phi_2,   exp(Z) - I = Z phi_1,
/// up to eight times as long by doubling (Skaflestad and Wright 2009, eq. 11):
///     phi_2(2Z) = (phi_1^2 + 2 phi_2)/4,   phi_1(2Z) = phi_1 (2I + Z phi_1)/2.
/// Nothing when the step is too long for that.
template <int capacity>
std::optional<ShortStep<capacity>> short_step(const StateMatrix<capacity>& A, int n, double h);

}  // namespace dynlab::inline numerics
