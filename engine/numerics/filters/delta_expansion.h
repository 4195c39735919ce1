#pragma once
#include "numerics/linalg/state_matrix.h"

namespace dynlab::inline numerics {

// States of a sampled system as combinations of the columns of a delta chain.

/// Coefficient 0 .. n-1 of det(delta I - E) for n <= 4 states (DeltaChain::alpha), by sums of principal minors: those
/// of slow poles keep their digits beside fast ones.
StateVector<4> delta_polynomial(const StateMatrix<4>& E, int n);

/// alpha of the product of two such polynomials, of degree n each.
StateVector<8> delta_product(const StateVector<4>& a, const StateVector<4>& b, int n);

/// (delta I - E)^-1 input = sum_j x_j delta^j/A: the state k of x_j is states(j, k).
template <int capacity>
struct StateExpansion {
    StateVector<capacity> alpha;
    StateMatrix<capacity> states;
};
/// n <= 4 states.
StateExpansion<4> expansion(const StateMatrix<4>& E, const StateVector<4>& input, int n);
/// For the cascade of two equal systems of n <= room/2 states each. Block by block, poles that are far apart cost no
/// digits twice.
template <int capacity>
StateExpansion<capacity> cascade_expansion(const StateMatrix<capacity>& E, const StateVector<capacity>& input, int n);

/// x of T x = b, where rows and columns of T may differ in size by many orders of magnitude.
template <int capacity>
StateVector<capacity> scaled_solution(StateMatrix<capacity> T, StateVector<capacity> b, int n);

}  // namespace dynlab::inline numerics
