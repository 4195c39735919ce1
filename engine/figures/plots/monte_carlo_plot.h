#pragma once
#include <string>

#include "figures/figure.h"
#include "numerics/validation/monte_carlo.h"

namespace dynlab::inline figures {

/// Histograms of all estimates: a row for each method, a column for each parameter, the truth marked. Columns share
/// their range, so that bias and scatter of the methods can be compared; values so far out that they would squeeze the
/// rest are left out, and their number stands above the panel. Throws InvalidArgument when a method has no estimates or
/// other parameters.
Figure monte_carlo_histograms(const MonteCarlo& study);

/// One parameter over another, a point for each run of each method, with the truth and the ellipse that an efficient
/// unbiased method's estimates fall into with probability `level` (Cramer-Rao bound, Gaussian). Throws InvalidArgument
/// for a parameter that a method does not have, or one given twice.
Figure monte_carlo_scatter(const MonteCarlo& study, const std::string& x_name, const std::string& y_name,
                           double level = 0.95);

/// What stands above such a figure's panel: how many of the estimates lie outside its ranges; empty where none do.
Message outside_text(const Panel& panel);

}  // namespace dynlab::inline figures
