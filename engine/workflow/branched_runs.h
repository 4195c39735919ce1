#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "workflow/run_script.h"

namespace dynlab::inline workflow {

using SliderNumbers = std::map<std::string, double>;

/// Runs a script up to the part that holds `cell`, once, and what follows once for each of `choices`, each time in a
/// copy of the process that stands there: what comes before the cell must not depend on them. `take` gets the records
/// in the order of the choices, their figures without curves: what a page draws them from is there for those that
/// differ from the one before the cell. A run that fails, or ends its process, says so in its record. Throws
/// EnvironmentError and Interrupted.
void run_from_cell(const RunRequest& request, const std::string& cell, const std::vector<SliderNumbers>& choices,
                   const std::function<void(RunRecord&&)>& take);

}  // namespace dynlab::inline workflow
