#pragma once
#include <vector>

#include "figures/figure.h"
#include "figures/named_model.h"

namespace dynlab::inline figures {

/// Responses of models to a unit step at time zero, over `t` (s) or a window chosen from the slowest model.
/// Discrete models are drawn as stairs; models that carry their confidence have a band. Throws InvalidArgument for no
/// models.
Figure step_plot(const std::vector<NamedModel>& models, const Vector& t = Vector());

/// Responses of models to a unit impulse at time zero, over `t` (s) or a window chosen from the slowest model.
/// Discrete models are drawn as stems. Throws InvalidArgument for no models.
Figure impulse_plot(const std::vector<NamedModel>& models, const Vector& t = Vector());

/// How many samples of a discrete model lie in a window from 0 to `end`; throws InvalidArgument where they are too many
/// for a figure.
Index samples_within(double end, double Ts);

}  // namespace dynlab::inline figures
