#pragma once
#include <vector>

#include "numerics/validation/fitted_data.h"

namespace dynlab::inline numerics {

// Each function checks the fitted data for one problem and adds its findings.
using DataIssues = std::vector<DataIssue>;

/// Outliers of the model's error by Hampel's rule (signals/repair.h, six robust standard deviations): up to 5 % of the
/// samples, no more than three in a row. Where they make up much of the error, the model is fitted again without them.
/// They are replaced in `fit.data`, so that they disturb no later test. Nothing where the model explains too little.
void find_error_outliers(FittedData& fit, const std::function<bool()>& cancel, DataIssues& findings);

/// "drift" (a straight line makes up most of it) and "random_walk": the error wanders (fitted_data.h), and its mean
/// over a twentieth of the data varies by more than 8 and 12 % of the output's standard deviation. The slow part is
/// subtracted from `fit.data`.
void find_disturbance(FittedData& fit, DataIssues& findings);

/// "noise" and "low_snr" from the error's standard deviation.
void find_noise(const FittedData& fit, DataIssues& findings);
/// "dead_time", when it is longer than a sample and than four standard errors; a lag where one more pole does as well.
void find_dead_time(const FittedData& fit, DataIssues& findings);
/// "offset", chosen by BIC (compare) and more than a tenth of the output's standard deviation; or, as a note, a smaller
/// offset at which the output rests while the input is zero at the beginning.
void find_offset(const FittedData& fit, DataIssues& findings);
/// "running_start": a free motion, selected by BIC (compare), that exceeds the error, amounts to 5 % of the output's
/// standard deviation and to three times the result of a fit of such a motion further on; or only the first of 24
/// sections does not follow the model (behind a dead time the unknown inputs from before the first sample still act).
void find_running_start(const FittedData& fit, DataIssues& findings);
/// "slow_sampling" (below 6 times the bandwidth, if the input reaches so far) and "fast_sampling" (above 400 times).
void find_sampling_rate(const FittedData& fit, DataIssues& findings);
/// "integrator": a real pole whose time constant is longer than the search window, and which makes up most of the
/// simulated movement.
void find_integrator(const FittedData& fit, DataIssues& findings);
/// "load": an integrator with a constant in addition to the input, so that its output ramps, explains the data as well
/// as the model or better. True if so: the model then has another cause for the ramp.
bool find_load(const FittedData& fit, DataIssues& findings);
/// "nonlinear" with sections (of 24, but for the first) whose rms error is more than four times the median of all and
/// 5 % of the output's standard deviation. True when there are any: no other test of the error means much then.
bool find_strange_sections(const FittedData& fit, DataIssues& findings);
/// The first section is such a one, or two dead times at the beginning (five samples at least).
bool has_strange_beginning(const FittedData& fit);

/// "nonlinear", "saturation" and "changing_gain": F-tests at level 2e-7 each, after whitening, of whether a static
/// curve at the input or at the output (broken lines), backlash there (play operators), or a gain that changes with
/// time explains of the error what no lagged input and output does, at least 2 % of the output's standard deviation.
void find_nonlinearity(const FittedData& fit, DataIssues& findings);
/// A gain that changes with time makes up 70 % of the error, which then is no disturbance.
bool gain_explains_error(const FittedData& fit);

/// "feedback": the input follows what the input did not cause. Cross-correlation of the whitened error with the
/// whitened input of the same and later samples (Haugh 1976; Pierce and Haugh 1977), chi-squared at level 1e-5. Of a
/// model that runs away, the errors are those of a prediction from the past of both signals.
void find_feedback(const FittedData& fit, DataIssues& findings);

/// "unstable": the model is unstable, or its simulation diverges from the data, so that its error is not usable.
bool find_runaway(const FittedData& fit, DataIssues& findings);

/// "late_input": the whitened error goes with the input of the same and later samples, or the delay ends at zero, and
/// the input one sample earlier explains the data better (fit/structure_advice.h).
bool find_late_input(const FittedData& fit, DataIssues& findings);

/// "causality": the model from output to input leaves less than two thirds of what the one from input to output
/// leaves, and explains more than half; and what the latter leaves goes with later inputs (F-test at level 1e-6 after
/// whitening), or its simulation runs away: columns exchanged. Searches a second model, if the first is poor.
bool find_exchange(const FittedData& fit, const std::function<bool()>& cancel, DataIssues& findings);

}  // namespace dynlab::inline numerics
