#pragma once
#include <string>
#include <vector>

#include "figures/figure.h"
#include "numerics/validation/crossvalidate.h"

namespace dynlab::inline figures {

/// The fit on every part that was left out, over the parts' numbers, with the mean of each output as a line. Throws
/// InvalidArgument when no part was done.
Figure cross_validation_plot(const CrossValidation& result, const std::vector<std::string>& output_names);

}  // namespace dynlab::inline figures
