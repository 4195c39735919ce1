#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// G = B/F of n poles and m zeros in parameters q = [c_0 .. c_(n-1) d_0 .. d_m] of polynomials that are orthogonal on
/// the frequencies: F = P_n + sum c_j P_j, B = sum d_j Q_j. Powers of s over some decades are all alike to a
/// regression; these are not. Brought to a monic F they are the coefficients offset + map q = [a_1 .. a_n b_0 .. b_m].
struct RationalBasis {
    Eigen::MatrixXcd P;  ///< K x (n + 1), column j holds P_j(s_k)
    Eigen::MatrixXcd Q;  ///< K x (m + 1)
    Vector offset;       ///< n + m + 1
    Matrix map;          ///< (n + m + 1) x (n + m + 1)

    ComplexVector denominator(const VectorView& q) const;     ///< F at the K points
    ComplexVector numerator(const VectorView& q) const;       ///< B
    Vector coefficients(const VectorView& q) const;           ///< [a_1 .. a_n b_0 .. b_m]
    Vector parameters(const VectorView& coefficients) const;  ///< the q that has these coefficients
};

/// For points s (K, on the imaginary axis) and weights of the two polynomials there. Throws InvalidArgument for points
/// that are too few for the degrees.
RationalBasis rational_basis(const ComplexVector& s, const VectorView& denominator_weights,
                             const VectorView& numerator_weights, Index poles, Index zeros);

}  // namespace dynlab::inline numerics
