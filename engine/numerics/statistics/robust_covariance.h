#pragma once
#include <vector>

#include "numerics/linalg/types.h"
#include "numerics/statistics/autoregression.h"

namespace dynlab::inline numerics {

/// The covariance of an estimate whose errors are colored, or of changing size.
struct RobustCovariance {
    Matrix covariance;                      ///< d x d
    Vector std;                             ///< d, its standard errors
    Index bandwidth = 1;                    ///< L below, samples
    std::vector<Autoregression> whitening;  ///< of each output's errors
};

/// Sandwich (heteroscedasticity and autocorrelation consistent) covariance of a theta that solves
/// sum_k z(k) e(k, theta) = 0, with H (d x d) the inverse of -d/dtheta sum z e: (Psi'Psi)^-1 with z = Psi for
/// output-error estimates, (Z'Phi)^-1 for instrumental variables. The z are known and free of noise, so that the color
/// of e alone makes the terms z(k) e(k) depend on each other: e is whitened by an autoregression
/// (autoregression.h) into w, and z'e = x'w with x the instruments colored backwards in time. What is left of
/// dependence is met after Newey and West (1987) with the Bartlett window, as Andrews and Monahan (1992) do with
/// prewhitened terms:
///     P = N/(N - d) sum_|l|<L (1 - |l|/L) sum_k v(k) v(k - l)',   v(k) = H x(k) w(k).
/// The window is the one of least mean square error for first-order autoregressive v (Andrews 1991, section 6, every
/// parameter counting alike):
///     L = 1.1447 (alpha N)^(1/3),   alpha = mean_i 4 rho_i^2/((1 - rho_i)^2 (1 + rho_i)^2),
/// N the number of instants, rounded up; it is 1 (White 1980) without any correlation. The result is positive
/// semidefinite and does not depend on the parameters' units; the work is O(N d (d + p)), p the autoregression's order.
/// `Z` is N x d, `e` has N values. If several `outputs` were fitted together, both contain one block of N/outputs rows
/// per output, at the same instants and with the weight of the output in the fit. v(k) then is the sum over the outputs
/// at one instant, so that the errors of one output may depend on those of another. `lengths` (summing to N/outputs)
/// are the lengths of uninterrupted parts, which are assumed to be independent of each other; empty for one part.
/// Throws InvalidArgument for sizes that do not match, values that are not finite, or N <= d.
RobustCovariance robust_covariance(const MatrixView& H, const MatrixView& Z, const VectorView& e,
                                   const std::vector<Index>& lengths = {}, Index outputs = 1);

/// The same for an output-error estimate with sensitivities Psi = d simulated/d theta (N x d), with corrections for
/// short data: each error is divided by one minus its leverage (HC3: MacKinnon and White 1985), and with one output and
/// up to 100 samples no variance is smaller than for errors of one size, H X'X H mean(w^2) (Angrist and Pischke 2009,
/// section 8.1).
RobustCovariance robust_covariance(const MatrixView& Psi, const VectorView& e, const std::vector<Index>& lengths = {},
                                   Index outputs = 1);

}  // namespace dynlab::inline numerics
