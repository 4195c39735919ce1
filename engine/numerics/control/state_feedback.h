#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// u = -K x and what it makes of the system.
struct StateFeedback {
    Matrix K;             ///< nu x n
    ComplexVector poles;  ///< of A - B K, n
};

/// The state feedback of dx/dt = A x + B u that makes the integral of x'Q x + u'R u smallest: K = R^-1 B'P with the
/// stabilizing solution of A'P + P A - P B R^-1 B'P + Q = 0, from the stable eigenvectors of the Hamiltonian matrix.
/// A n x n, B n x nu, Q n x n symmetric and not negative, R nu x nu symmetric and positive. Throws InvalidArgument for
/// other sizes, and when no feedback makes the criterion finite: a mode that B does not reach is unstable, or Q does
/// not see one on the imaginary axis. By duality the transposed K of (A', C') is the gain of an observer. Reference:
/// Potter (1966), SIAM J. Appl. Math. 14, 496-501; Anderson and Moore (1990), Optimal Control, section 3.2.
StateFeedback linear_quadratic_regulator(const MatrixView& A, const MatrixView& B, const MatrixView& Q,
                                         const MatrixView& R);

/// The state feedback of a system with one input that puts the poles of A - B K where `poles` says (n of them, complex
/// ones in conjugate pairs), by Ackermann's formula. Meant for
/// a dozen states at most. Throws InvalidArgument for other sizes, an unpaired complex pole, a mode that B does not
/// reach, or poles that rounding keeps from their places.
/// Reference: Ackermann (1972), Regelungstechnik 20, 297-300.
StateFeedback pole_placement(const MatrixView& A, const MatrixView& B, const ComplexVector& poles);

}  // namespace dynlab::inline numerics
