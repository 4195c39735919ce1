#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Polynomials p_0 .. p_n with real coefficients, p_j of degree j, orthonormal on points of the imaginary axis and
/// their conjugates: sum_k weight_k^2 Re(conj(p_i(s_k)) p_j(s_k)) is one for i = j and zero otherwise.
struct OrthogonalPolynomials {
    Eigen::MatrixXcd values;  ///< K x (n + 1), column j holds p_j(s_k)
    Matrix coefficients;      ///< (n + 1) x (n + 1), column j holds those of p_j, s^n first
};

/// By the recurrence s p_j = sum h_i p_i (Arnoldi's process with a second pass, which keeps them orthogonal where
/// powers of s are all alike). Throws InvalidArgument for sizes that differ and for points or weights that carry fewer
/// than n + 1 polynomials. Reference: Brubeck, Nakatsukasa and Trefethen (2021), Vandermonde with Arnoldi.
OrthogonalPolynomials orthogonal_polynomials(const ComplexVector& s, const VectorView& weights, Index degree);

}  // namespace dynlab::inline numerics
