#pragma once
#include <map>
#include <string>
#include <vector>

#include "figures/figure.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline figures {

/// Parameters over time as a recursive method knew them, a panel for each, with their confidence bands. `truth`, by the
/// names of parameters, is spread evenly over the record (one value: constant). The panels
/// show what the later two thirds and the truth need: the first guesses may leave them. Throws InvalidArgument for a
/// history without instants, and a truth of no parameter.
Figure history_plot(const ParameterHistory& history, const std::vector<std::string>& names,
                    const std::map<std::string, Vector>& truth = {}, double level = 0.95);

}  // namespace dynlab::inline figures
