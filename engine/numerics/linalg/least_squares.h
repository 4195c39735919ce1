#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The theta that minimizes |b - A theta|^2 for an N x d matrix A with N >= d.
struct LeastSquares {
    Vector solution;          ///< d; the one of least scaled norm when the rank is deficient
    Vector residuals;         ///< N, b - A theta
    Matrix inverse_gram;      ///< d x d, (A'A)^-1 (pseudo-inverse when the rank is deficient); times the noise
                              ///< variance it is the covariance of theta for white noise
    Index rank;               ///< numerical rank
    double condition_number;  ///< of A with its columns scaled to norm one; infinite when the rank is deficient
};

/// Householder QR of the column-scaled A, then singular values of the triangular factor. Throws InvalidArgument for
/// sizes that do not fit, more columns than rows, or values that are not finite.
LeastSquares solve_least_squares(const MatrixView& A, const VectorView& b);

}  // namespace dynlab::inline numerics
