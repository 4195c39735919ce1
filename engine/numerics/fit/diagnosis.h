#pragma once
#include <string>

#include "numerics/fit/data_checks.h"

namespace dynlab::inline numerics {

/// What is told of a fit: warnings are whole sentences, added to those that are there already.

/// Beyond this condition number the parameters are not told apart.
inline constexpr double kAmbiguousCondition = 1e10;

/// Of a search that did not come to its end.
void warn_of_search(Fit& fit, const FitOptions& options);
/// Of an ambiguous condition number, otherwise of parameters (but for delays) whose standard error is larger than their
/// value. `simpler` is what may help, apart from a richer input.
void warn_of_doubtful_parameters(Fit& fit, const std::string& simpler = "a simpler structure");
/// Of an estimated delay (s) at an edge of the `range` it was looked for in, or of zero; `channel` as channel_text.
void warn_of_delay(Fit& fit, double delay, const DelayRange& range, const std::string& channel);
/// Of discrete-time models that are not stable.
void warn_of_unstable_polynomials(Fit& fit);

/// " from input 2 to output 1" for messages, nothing for the only channel.
std::string channel_text(const TransferStructure& structure, std::size_t channel);

/// Fills names, models and std of a continuous-time fit from structure, theta and covariance, and warns of poles and
/// zeros that nearly cancel, of doubtful parameters, and of unstable channels.
void describe_models(Fit& fit);

/// The same, with the message, for an output-error search (`method` begins the sentence) over the given range of
/// delays: warns of its end, of free delays at an edge of the range, and of those known only to within one sampling
/// time of `data`.
void describe_search(Fit& fit, const IdData& data, const std::string& method, const FitOptions& options,
                     const DelayRange& range);

/// "converged after 5 iterations", or "stopped after".
std::string ending_text(const Fit& fit);
/// The message: a first sentence, then all warnings.
void set_message(Fit& fit, const std::string& first);
/// "fit 93.21 % (simulation)", of all outputs.
std::string simulation_text(const Fit& fit);

}  // namespace dynlab::inline numerics
