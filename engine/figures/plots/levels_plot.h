#pragma once
#include "figures/figure.h"
#include "numerics/models/frequency_data.h"

namespace dynlab::inline figures {

/// What a best linear approximation found in the output, in dB over a logarithmic frequency axis (rad/s): the response
/// at the excited lines, noise, nonlinear distortion, and what odd and even lines without input show. Levels that are
/// not above zero are left out. Throws InvalidArgument where there are no levels.
Figure levels_plot(const FrequencyData& data);

}  // namespace dynlab::inline figures
