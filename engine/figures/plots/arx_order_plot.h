#pragma once
#include "figures/figure.h"
#include "numerics/validation/arx_selection.h"

namespace dynlab::inline figures {

/// The best value of a criterion for each number of parameters, with the chosen structure marked. The loss has a curve
/// for each data set: the estimation data and the validation data. Throws InvalidArgument for no candidates.
Figure arx_order_plot(const ArxSelection& selection, ArxCriterion criterion, const OrderChoice& choice);

}  // namespace dynlab::inline figures
