#pragma once
#include <vector>

#include "numerics/criteria/process_output.h"

namespace dynlab::inline numerics {

/// Start values for the output-error search on a process model, and the loss over a grid of delays.
struct ProcessScan {
    std::vector<Vector> starts;  ///< full parameter vectors of the ProcessOutput, best first
    Vector delays;               ///< samples; empty for a structure without delay
    Vector losses;               ///< for each delay: smallest mean square error over the grid of time constants
};

/// Lays a logarithmic grid over the time constants (and damping ratios) from a third of a sample to three records, and
/// an even one of at most `delay_count` delays between the model's bounds, whole samples apart. At every grid point the
/// gain (and the gain times Tz), the initial values and the offset enter linearly and are solved for by least squares
/// on at most 800 evenly chosen samples. The starts are the best points that differ from each other. Needs no guess
/// from the user, and always returns one start at least.
ProcessScan scan_process_grid(const ProcessOutput& model, const VectorView& y, int delay_count);

}  // namespace dynlab::inline numerics
