#pragma once
#include <optional>

#include "numerics/estimators/grey_box/greyest.h"

namespace dynlab::inline numerics {

/// What a fit that takes the initial states for granted misses when the record begins in the middle of a movement: one
/// sentence with the option and about the fit that it leads to, or nothing. A look ahead: what one Gauss-Newton step of
/// parameters and initial states together leaves of the errors. It is told when BIC falls by more than 10, with as many
/// samples as white errors of the same power at low frequencies would have, and the fit rises by half a point.
/// `weights`: of the outputs' errors.
std::optional<Message> missed_initial_state(const IdData& data, const GreyFit& fit, const Vector& weights);

}  // namespace dynlab::inline numerics
