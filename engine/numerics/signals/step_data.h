#pragma once

#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// A plateau of a signal: its robust mean (a fifth of the values dropped at either side) over [from, to] seconds.
struct Level {
    double value = 0, from = 0, to = 0;
};

/// One step experiment, taken apart: what every reading of a step response starts from.
struct StepData {
    Vector t, u, y;           ///< the data, N values each
    Index step_index = 0;     ///< first sample with the new input; 0 if the data begin with the step
    double step_time = 0;     ///< its instant, s
    double input_before = 0;  ///< 0 if the data begin with the step
    double input_after = 0;
    Level initial;  ///< output before the step (at the step when nothing was recorded before it)
    Level final;    ///< output at the end
    double noise_std = 0;
    Vector smoothed;  ///< N values: mean before the step, moving local parabola after it (never across the step)

    double input_change() const { return input_after - input_before; }
    double output_change() const { return final.value - initial.value; }
    /// Rise of smoothed sample k: 0 at the initial level, 1 at the final one, whatever the step's sign.
    double rise(Index k) const { return (smoothed[k] - initial.value) / output_change(); }
    /// First instant (s) at which the smoothed response has risen to `part` of its change, by linear interpolation.
    double crossing_time(double part) const;
};

/// Finds the step in one-input one-output data of one experiment. The input must have one level, then another
/// (deviations up to a tenth of the step count as noise); an input that is constant and not zero counts as a step from
/// zero at the first sample. The response must have settled by the end. The smoothing window is as wide as needed to
/// reduce the noise to 0.25 % of the step, and at most `widest_window` times the rise from 28.3 % to 63.2 %, so that a
/// parabola still follows the response; single outliers are ignored. Throws InvalidArgument with the reason if the data
/// are not those of a step experiment.
StepData read_step_data(const IdData& data, double widest_window = 2);

}  // namespace dynlab::inline numerics
