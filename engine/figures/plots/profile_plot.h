#pragma once
#include "figures/figure.h"
#include "numerics/validation/intervals/profile_likelihood.h"

namespace dynlab::inline figures {

/// The rise of the loss over a parameter's values, the level that bounds the interval, and the parabola that
/// corresponds to the standard error. `unit`: of the parameter, for the axis; may be empty.
Figure profile_plot(const Profile& profile, const std::string& unit);

}  // namespace dynlab::inline figures
