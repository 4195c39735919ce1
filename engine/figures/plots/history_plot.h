#pragma once
#include <map>
#include <string>
#include <vector>

#include "figures/figure.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline figures {

/// Parameters over time as a recursive method estimated them, one panel each, with their confidence bands. `truth`, by
/// the names of parameters, is spread evenly over the data (one value: constant). The panels' ranges follow the last
/// two thirds and the truth: the first estimates may leave them. Throws InvalidArgument for a history without instants,
/// and a truth of no parameter.
Figure history_plot(const ParameterHistory& history, const std::vector<std::string>& names,
                    const std::map<std::string, Vector>& truth = {}, double level = 0.95);

}  // namespace dynlab::inline figures
