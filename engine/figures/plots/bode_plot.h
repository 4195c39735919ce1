#pragma once
#include <vector>

#include "figures/figure.h"
#include "figures/named_model.h"

namespace dynlab::inline figures {

/// The empty panels of a frequency response.
struct FrequencyPanels {
    Panel magnitude, phase;
};
FrequencyPanels frequency_panels();

/// Magnitude (dB) above unwrapped phase (degrees) over a logarithmic frequency axis (rad/s), at `w` or at frequencies
/// chosen from poles and zeros of all models. Each discrete model ends at its pi/Ts, where a line marks it; models that
/// carry their confidence have bands. Measured responses are drawn as points beside them, with bands where their
/// variances are known, at phases within half a turn of the first model's; where the input was held between all their
/// samples, continuous-time models are drawn as such samples show them. Throws InvalidArgument for nothing to draw
/// or frequencies that are not positive.
Figure bode_plot(const std::vector<NamedModel>& models, const Vector& w = Vector(),
                 const std::vector<NamedResponse>& responses = {});

/// The frequencies used when none are given: logarithmic, over the joint range of natural_frequency_grid().
Vector joint_frequency_grid(const std::vector<NamedModel>& models, Index count);

}  // namespace dynlab::inline figures
