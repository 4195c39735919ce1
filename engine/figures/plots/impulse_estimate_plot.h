#pragma once
#include "figures/figure.h"
#include "figures/named_model.h"
#include "numerics/models/impulse_estimate.h"

namespace dynlab::inline figures {

/// The estimate divided by the sampling time `Ts`, as stems over time, with the band around zero that random values
/// would not leave with probability `level`, and the impulse responses of models. The lag that shows the dead time is
/// marked.
Figure impulse_estimate_plot(const ImpulseEstimate& estimate, double Ts, const std::vector<NamedModel>& models,
                             double level = 0.99);

}  // namespace dynlab::inline figures
