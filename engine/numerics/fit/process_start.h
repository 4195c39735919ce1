#pragma once
#include <vector>

#include "numerics/criteria/process_output.h"

namespace dynlab::inline numerics {

/// Start values for the output-error search on a process model, and the loss over a grid of delays. Times in the
/// output's time units.
struct ProcessScan {
    std::vector<Vector> starts;  ///< full parameter vectors of process_output(), best first
    Vector delays;               ///< empty for a structure without delay
    Vector losses;               ///< for each delay: smallest mean square error over the grid of time constants
};

/// Tries a logarithmic grid over the time constants (and damping ratios) from a third of a time unit to three times the
/// data's length. The delays form an even grid of at most `delay_count` points between the bounds of `output`, whole
/// units apart, to which delays near the `likely_delays` are added. A resonance is also tried at the `peaks` (rad per
/// time unit). At every grid point the gain (and the gain times Tz), the initial values and the offset enter linearly;
/// least squares on at most 800 evenly spaced samples determines them. The starts are the best points that differ from
/// each other. Needs no initial values from the user, and always returns at least one start. `output` has
/// transfer_structure(structure).
ProcessScan scan_process_grid(const ProcessStructure& structure, const TransferOutput& output, int delay_count,
                              const Vector& likely_delays = {}, const Vector& peaks = {});

}  // namespace dynlab::inline numerics
