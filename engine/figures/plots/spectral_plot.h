#pragma once
#include <string>
#include <vector>

#include "figures/figure.h"
#include "figures/named_model.h"
#include "numerics/fit/spectral_estimate.h"

namespace dynlab::inline figures {

/// Bode diagram of an estimate, with confidence bands of probability `level` where it has standard errors, and of
/// models over it. An estimate without standard errors is drawn as points. Where the error is larger than the magnitude
/// nothing is known of the phase, and its curve has a gap. A panel in which the estimate has no value at any frequency
/// shows a sentence in place of the curve.
Figure spectral_plot(const SpectralEstimate& estimate, const Message& name, const std::vector<NamedModel>& models,
                     double level = 0.99);

/// Whether the magnitude exceeds its error, for this probability, at one frequency at least.
bool has_known_phase(const SpectralEstimate& estimate, double level);

}  // namespace dynlab::inline figures
