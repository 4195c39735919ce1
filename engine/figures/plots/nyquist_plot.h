#pragma once
#include <vector>

#include "figures/figure.h"
#include "figures/named_model.h"

namespace dynlab::inline figures {

/// G(j w) in the complex plane for growing positive w (an arrow shows the direction), its mirror image for negative w,
/// and the critical point -1. Parts far outside, as integrators have them, are left out. Frequencies as in
/// bode_plot.
Figure nyquist_plot(const std::vector<NamedModel>& models, const Vector& w = Vector());

}  // namespace dynlab::inline figures
