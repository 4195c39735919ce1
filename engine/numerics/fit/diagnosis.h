#pragma once
#include <optional>
#include <string>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// What estimators refuse. `method` begins the messages of the InvalidArgument they throw.

/// Data without inputs, with an input that is zero throughout, or with an output that never changes.
void check_signals(const std::string& method, const IdData& data);

/// The same; data of other channels than the structure, with fewer than 3 samples per parameter, not longer than a
/// fixed delay, or with a constant input although the output does not start from rest, so that it is no step; where an
/// `offset` is removed or estimated, the output may rest anywhere.
void check_transfer_data(const std::string& method, const IdData& data, const TransferStructure& structure,
                         Offset offset = Offset::kNone);

/// Those of check_signals, and data that are not regularly sampled.
void check_sampled_data(const std::string& method, const IdData& data);

/// No more samples than `values` to estimate.
void check_sample_count(const std::string& method, Index samples, Index values);

/// For data whose inputs never change: a fit of so many estimated values that explains no transient (see
/// require_transient in criteria/initial_conditions.h). A canceled fit passes.
void check_transient(const std::string& method, const IdData& data, const Fit& fit, Index values);

double shortest_experiment(const IdData& data);  ///< s, of all experiments

struct DelayRange {
    double least = 0, largest = 0;
    std::string unit = "s";  ///< of both: the time unit of the data
};
/// The search range of a free delay: least_delay and largest_delay; without the latter a quarter of the shortest
/// experiment. Throws InvalidArgument for a largest delay that is not shorter than the shortest experiment.
DelayRange delay_range(const IdData& data, const FitOptions& options);

/// What is reported of a fit. Warnings are added to those of the fit.

/// Above this condition number the data do not determine the parameters.
inline constexpr double kAmbiguousCondition = 1e10;

/// Of a search that did not come to its end.
void warn_of_search(Fit& fit, const FitOptions& options);
/// Names of the parameters (but for delays) whose standard error is larger than their value or not a number.
std::vector<std::string> undetermined_parameters(const std::vector<std::string>& names, const VectorView& theta,
                                                 const VectorView& std);
/// Ways, other than a richer input, to deal with parameters that the data do not determine.
enum class SimplerModel { kStructure, kFewerBins, kFewerTerms, kFewerFreeParameters };
/// Of an ambiguous condition number, otherwise of parameters (but for delays) whose standard error is larger than their
/// value.
void warn_of_doubtful_parameters(Fit& fit, SimplerModel simpler = SimplerModel::kStructure);
/// A model of an output that explains less than so many per cent of its variance is poor: what its parameters are says
/// little of the system. With white noise as strong as the answer to the input, the true model explains half.
inline constexpr double kLittleExplained = 25;
/// Whether a fit in per cent is that poor.
bool explains_little(double fit_percent);
/// A continuous-time pole to the right of the imaginary axis, a discrete-time one outside the unit circle.
bool has_unstable_pole(const TransferFunction& G);

/// Input and output of a channel, from 1.
struct ChannelPlace {
    std::size_t input, output;
};
/// For messages; nothing for the only channel.
std::optional<ChannelPlace> channel_place(const TransferStructure& structure, std::size_t channel);

/// Of an estimated delay (s) at an edge of the `range` it was looked for in, or of zero where the model explains more
/// than a little.
void warn_of_delay(Fit& fit, double delay, const DelayRange& range, const std::optional<ChannelPlace>& channel = {});

/// Takes away (makes infinite) the standard errors of the parameters of these names, which the data do not determine.
void withdraw_errors(Fit& fit, const std::vector<std::string>& names);
/// Parameters other than delays that a search left at a bound which is not asked for: their errors are withdrawn.
void withdraw_errors_at_bounds(Fit& fit, const FitOptions& options);
/// Whether an input changes.
bool inputs_change(const IdData& data);
/// Removes the standard errors of gain and delays, with a warning, if no input changes and the output has an offset:
/// the estimates then assume that the inputs were zero before. Returns whether this is the case.
bool withdraw_errors_of_gain(Fit& fit, const IdData& data);
/// Whether the delay of the channel is known only to within one sampling time: a step of a held input reaches the
/// output through the direct term at the next sampling instant, wherever between two instants it arrives, and n + 1
/// weights of the sampled response cannot determine n + 1 coefficients and a delay.
bool has_ambiguous_delay(const TransferFunction& G, const IdData& data);

/// What a warning of an unstable model advises: nothing; the option `stable`; srivc with that option; a look at the
/// controller, the orders and the cutoff frequency.
enum class UnstableAdvice { kNone, kStableOption, kStableSrivc, kController };
/// Fills names, models and std of a continuous-time fit from structure, theta and covariance, and warns of poles and
/// zeros that nearly cancel, of doubtful parameters, and of unstable channels.
void describe_models(Fit& fit, UnstableAdvice advice = UnstableAdvice::kStableSrivc);

/// The same for an output-error search over the given range of delays: warns of its end, of free delays at an edge of
/// the range, and of those known only to within one sampling time of `data`.
void describe_search(Fit& fit, const IdData& data, const FitOptions& options, const DelayRange& range);

/// Whether the search converged or could make no further progress.
bool has_settled(const Fit& fit);
/// "5 iterations".
Message iteration_count(const Fit& fit);
/// "93.21", or "93.21 % and 88 %" without the last sign, of all outputs.
Message fits_text(const Fit& fit);
/// "fit 93.21 % (simulation)", of all outputs.
Message simulation_text(const Fit& fit);

}  // namespace dynlab::inline numerics
