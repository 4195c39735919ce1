#pragma once
#include <vector>

#include "figures/figure.h"
#include "figures/named_model.h"

namespace dynlab::inline figures {

/// Poles (crosses) and zeros (circles) over lines of equal damping ratio 0.2, 0.4, 0.6, 0.8: rays of the s plane, or
/// spirals inside the unit circle for discrete models. Models that carry their confidence have the ellipse of each
/// complex pole and zero and the interval of each real one. Throws InvalidArgument for no models, for continuous and
/// discrete ones mixed, and when there is neither pole nor zero.
Figure pole_zero_map(const std::vector<NamedModel>& models);

}  // namespace dynlab::inline figures
