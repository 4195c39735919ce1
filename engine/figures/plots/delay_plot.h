#pragma once
#include "figures/figure.h"
#include "numerics/validation/delay_search.h"

namespace dynlab::inline figures {

/// The smallest mean square simulation error over the delay, with the estimate and a rival marked. Throws
/// InvalidArgument for a search that was stopped.
Figure delay_plot(const DelaySearch& search);

}  // namespace dynlab::inline figures
