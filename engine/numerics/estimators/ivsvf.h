#pragma once
#include "numerics/estimators/lssvf.h"

namespace dynlab::inline numerics {

/// The two-step instrumental-variable method on state-variable filtered signals: lssvf first, whose model (unstable
/// poles mirrored into the left half plane) is simulated exactly; its output x, filtered as y is, takes the place of y
/// in the instruments z, and theta solves
///     sum_k z(k) (p^n y_f - phi' theta) = 0.
/// The estimate is consistent for any noise that is independent of the inputs, unlike lssvf; its variance depends on
/// lambda. The covariance is variance (Z'Phi)^-1 Z'Z (Phi'Z)^-1, of a white equation error: see color_covariance.
/// Options, structures and errors as for lssvf; with (beta/(p + lambda))^n it is ivgpmf. Also throws InvalidArgument if
/// the instruments leave the equations singular. References: Young and Jakeman (1980); Garnier and Wang (2008), section
/// 1.4.
Fit ivsvf(const IdData& data, const TransferStructure& structure, const SvfOptions& options);

}  // namespace dynlab::inline numerics
