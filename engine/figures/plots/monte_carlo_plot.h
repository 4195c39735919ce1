#pragma once
#include <string>

#include "figures/figure.h"
#include "numerics/validation/monte_carlo.h"

namespace dynlab::inline figures {

/// Histograms of all estimates: a row for each method, a column for each parameter, with the true value marked. Columns
/// share their range, so that bias and scatter of the methods can be compared. Outliers that would compress the rest
/// are left out, and a text above the panel states their number. Throws InvalidArgument if a method has no estimates or
/// other parameters.
Figure monte_carlo_histograms(const MonteCarlo& study);

/// One parameter over another, a point for each run of each method, with the truth and the ellipse that an efficient
/// unbiased method's estimates fall into with probability `level` (Cramer-Rao bound, Gaussian). Throws InvalidArgument
/// for a parameter that a method does not have, or one given twice.
Figure monte_carlo_scatter(const MonteCarlo& study, const std::string& x_name, const std::string& y_name,
                           double level = 0.95);

/// The text above such a figure's panel: how many of the estimates lie outside its ranges; empty if none do.
Message outside_text(const Panel& panel);

}  // namespace dynlab::inline figures
