#pragma once
#include "figures/figure.h"
#include "numerics/validation/order_selection.h"

namespace dynlab::inline figures {

/// A criterion over the number of poles, one curve for each number of zeros (the best of several delays), the chosen
/// structure marked; for a single pair of poles and zeros, over the delay instead. kRecommended draws the validation
/// fit if there is one and BIC otherwise. Candidates without an estimate are left out. Throws InvalidArgument if
/// nothing is left, and for kValidationFit without validation data.
Figure order_plot(const OrderSelection& selection, OrderCriterion criterion, const OrderChoice& choice);

/// An open circle around the point of the chosen structure.
Curve mark_of_choice(double x, double y);

}  // namespace dynlab::inline figures
