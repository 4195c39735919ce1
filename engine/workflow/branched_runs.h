#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "workflow/run_script.h"

namespace dynlab::inline workflow {

using SliderNumbers = std::map<std::string, double>;

/// Runs a script once up to the part that contains `cell`, and the rest once for each of `choices`, each time in a copy
/// of the process at that point: the code before the cell must not depend on the choices. `take` gets the run results
/// in the order of the choices, without the curves of their figures; the page's drawing data are there for figures that
/// differ from those before the cell. A run that fails, or ends its process, reports this in its run results. Throws
/// EnvironmentError and Interrupted.
void run_from_cell(const RunRequest& request, const std::string& cell, const std::vector<SliderNumbers>& choices,
                   const std::function<void(RunRecord&&)>& take);

}  // namespace dynlab::inline workflow
