#pragma once
#include "numerics/linalg/types.h"
#include "numerics/models/state_space.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// A sampled single-input system with p outputs whose input acts through its neighboring samples, d samples late:
///   x[k+1] = F x[k] + G [u[k-d+1]; u[k-d]; u[k-d-1]],   y[k] = C x[k] + D [u[k-d]; u[k-d-1]].
/// The signal begins at its first sample and is zero, not a ramp, before it: the step and the output at k = d use
/// first_G [u[1]; u[0]] and first_D u[0] instead (free motion before).
struct SampledSystem {
    Matrix F;         ///< n x n
    Matrix G;         ///< n x 3
    Matrix first_G;   ///< n x 2
    Matrix C;         ///< p x n
    Matrix D;         ///< p x 2
    Vector first_D;   ///< p
    Index delay = 0;  ///< d
};

/// A delay as whole samples and the rest in [0, Ts) seconds; delays within rounding of a multiple count as one.
struct SplitDelay {
    Index samples = 0;
    double rest = 0;
};
SplitDelay split_delay(double delay, double Ts);

/// dx/dt = A x + B u(t - delay), y = C x + D u(t - delay) at the instants k Ts, exact for an input that is held (zoh)
/// or linearly interpolated (foh) between samples; B and D have one column. Any delay >= 0. (Astrom and Wittenmark
/// 1997, section 2.3; numerics of Van Loan 1978.)
SampledSystem discretize(const MatrixView& A, const VectorView& B, const MatrixView& C, const VectorView& D, double Ts,
                         Hold hold, double delay = 0);

/// A discrete-time system in the same form: x[k+1] = A x[k] + B u[k-d], y[k] = C x[k] + D u[k-d].
SampledSystem discrete_system(const MatrixView& A, const VectorView& B, const MatrixView& C, const VectorView& D,
                              Index delay);

/// The outputs s^n/den, ..., s/den, 1/den of one signal (n + 1 of them, n = degree of the monic `den`), the highest
/// from the identity s^n/den = 1 - sum_i den_i s^(n-i)/den: what the regressors of continuous-time estimators are
/// made of.
SampledSystem derivative_filter(const VectorView& den, double Ts, Hold hold, double delay = 0);

}  // namespace dynlab::inline numerics
