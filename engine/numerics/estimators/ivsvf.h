#pragma once
#include "numerics/estimators/lssvf.h"

namespace dynlab::inline numerics {

/// The two-step instrumental-variable method on state-variable filtered signals: lssvf first, whose model (unstable
/// poles mirrored into the left half plane) is simulated exactly; its output x, filtered as y is, takes the place of y
/// in the instruments z, and theta solves
///     sum_k z(k) (p^n y_f - phi' theta) = 0.
/// Consistent for any noise that is independent of the inputs, unlike lssvf; its scatter depends on lambda. Covariance
/// variance (Z'Phi)^-1 Z'Z (Phi'Z)^-1, of a white equation error: see color_covariance. Options, structures and errors
/// as for lssvf; (beta/(p + lambda))^n makes it ivgpmf. Throws InvalidArgument, besides, where the instruments leave
/// the equations singular. References: Young and Jakeman (1980); Garnier and Wang (2008), section 1.4.
Fit ivsvf(const IdData& data, const TransferStructure& structure, const SvfOptions& options);

}  // namespace dynlab::inline numerics
