#pragma once
#include <functional>
#include <vector>

#include "figures/figure.h"
#include "figures/named_model.h"
#include "numerics/simulation/time_response.h"

namespace dynlab::inline figures {

/// What step_plot and impulse_plot share: one curve per model over one window. `discrete_style` draws the samples of
/// discrete models.
Figure time_response_figure(const std::vector<NamedModel>& models, const Vector& t, CurveStyle discrete_style,
                            const std::function<TimeResponse(const TransferFunction&, const VectorView&)>& response);

}  // namespace dynlab::inline figures
