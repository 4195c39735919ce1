#pragma once
#include <vector>

#include "numerics/criteria/transfer_output.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Output-error estimate from a given start:
///     minimize sum_k w_i^2 (y_i(k) - sum_j B_ij/A_ij u_j(k - delay) - free motion - offset)^2
/// over all parameters of the structure together with the initial values and offsets that `condition` asks for, in
/// all experiments, by Levenberg-Marquardt with exact sensitivities (criteria/transfer_output.h). `theta_start` holds
/// the parameters of the structure (s); unstable starts are mirrored when their simulation has no end, initial values
/// and offsets start from least squares. Free delays stay between least_delay and largest_delay of the options
/// (delay_range); where the output is not smooth in them, the search also sets out from the two neighboring sampling
/// intervals. Steps to models whose simulation grows beyond bounds raise the loss and are never taken.
///
/// Outputs that share no denominator are separate problems and are solved in turn. Other outputs are weighted with one
/// over the standard deviation of their errors, which two rounds determine; the trace then counts weighted squares.
///
/// `masked_seconds`: with an estimated start, the first `masked_seconds` seconds of each experiment do not count,
/// because unknown inputs from before the experiment still arrive then. An initial value then is that of the free
/// motion after them, extrapolated back to the start.
///
/// `FitOptions` used here: least_delay, largest_delay, max_iterations, tolerance, cancel, stable, fixed (their standard
/// errors are zero), output_weights. The data are not changed: the caller must remove an operating point first
/// (without_operating_points). Sets every field except delay_grid and delay_loss. `warnings` reports doubtful results;
/// the function does not throw for them. Throws InvalidArgument for data that do not match the structure
/// (check_transfer_data), for another length of theta_start, or for no more samples than values to estimate.
Fit refine_output_error(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                        const Vector& theta_start, const FitOptions& options, double masked_seconds = 0);

/// How such a search ended, with the iterations of its whole trace.
Message output_error_message(const Fit& fit);

/// `masked_seconds` for a model with this delay (s), or with the delays of a fit: the longest delay plus one sample;
/// zero if the start is not estimated, and if it would be half of the shortest experiment.
double masked_start(const StartCondition& start, double delay, const IdData& data);
double masked_start(const Fit& fit, const IdData& data);

/// All values estimated under a start condition: parameters, initial values and offsets.
Index value_count(const TransferStructure& structure, const StartCondition& condition, Index experiments);

/// Per output: the sum of squares of the samples that count about the mean of each experiment.
Vector counted_variations(TransferOutput model);

/// Makes of a fit in the parameters of a search, [own ones; the initial values and offsets of `model`], one in seconds:
/// its own parameters, their covariance and trace in the units `seconds`, start condition, initial values and offsets.
void keep_parameters(Fit& fit, const TransferOutput& model, const StartCondition& condition, const Vector& seconds);
/// The way back: where a search begins at this fit.
Vector search_point(const Fit& fit, const TransferOutput& model, const Vector& seconds);

/// Sets initial values and offsets, at the end of theta, to those that suit the other parameters best, by least
/// squares; to zero where the simulation grows beyond all bounds.
void solve_linear_part(const TransferOutput& model, Vector& theta);

/// One output, as a separate problem, of a problem whose outputs share no denominator.
struct OutputProblem {
    IdData data;                  ///< all inputs, one output
    TransferStructure structure;  ///< its channels
    std::vector<Index> places;    ///< of its parameters among all
};

/// Whether no denominator serves channels of two outputs.
bool outputs_are_separate(const TransferStructure& structure);

/// The separate problem of one output (0-based).
OutputProblem output_problem(const IdData& data, const TransferStructure& structure, Index output);

/// The estimates of all outputs as one estimate of the whole structure: covariance block by block, the worst
/// termination and condition number; iteration k of the trace has each output at its k-th or last iteration. Standard
/// errors, warnings and message are left empty: refine_output_error writes them.
Fit join_outputs(const TransferStructure& structure, const std::vector<OutputProblem>& problems,
                 const std::vector<Fit>& estimates);

}  // namespace dynlab::inline numerics
