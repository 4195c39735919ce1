#pragma once
#include <optional>

#include "numerics/estimators/grey_box/greyest.h"

namespace dynlab::inline numerics {

/// Estimates what a fit with assumed initial states loses when the data begin in the middle of a transient. Returns one
/// sentence with the option to use and the approximate fit that results, or no value. The estimate is the reduction of
/// the errors by one Gauss-Newton step of parameters and initial states together. The message is returned when BIC
/// falls by more than 10 and the fit rises by half a point. BIC counts as many samples as white errors of the same
/// power at low frequencies would have. `weights`: of the outputs' errors.
std::optional<Message> missed_initial_state(const IdData& data, const GreyFit& fit, const Vector& weights);

}  // namespace dynlab::inline numerics
