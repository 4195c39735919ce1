#pragma once
#include <string>
#include <vector>

#include "figures/figure.h"
#include "figures/named_model.h"
#include "numerics/fit/spectral_estimate.h"

namespace dynlab::inline figures {

/// Bode diagram of an estimate, with confidence bands of probability `level` where it has standard errors, and of
/// models over it. An estimate without standard errors is drawn as points. Where the error is larger than the magnitude
/// nothing is known of the phase, and its curve has a gap.
Figure spectral_plot(const SpectralEstimate& estimate, const Message& name, const std::vector<NamedModel>& models,
                     double level = 0.99);

}  // namespace dynlab::inline figures
