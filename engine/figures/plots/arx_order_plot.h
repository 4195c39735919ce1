#pragma once
#include "figures/figure.h"
#include "numerics/validation/arx_selection.h"

namespace dynlab::inline figures {

/// The best value of a criterion for each number of parameters, the chosen structure marked. For the loss there is a
/// curve for each record: the estimation's own, and the second one's. Throws InvalidArgument for no candidates.
Figure arx_order_plot(const ArxSelection& selection, ArxCriterion criterion, const OrderChoice& choice);

}  // namespace dynlab::inline figures
