#pragma once
#include "numerics/criteria/denominator_group.h"
#include "numerics/fit/transfer_estimate.h"

namespace dynlab::inline numerics {

/// Throw InvalidArgument, which begins with the method's name: data without inputs, of other channels than the
/// structure, with fewer than 3 samples per parameter, with an input that is zero throughout (or constant although the
/// output does not start from rest, so that it is no step), or with an output that never changes.
void check_transfer_data(const char* method, const IdData& data, const TransferStructure& structure);

/// For data whose inputs never change: throws InvalidArgument when the estimate explains no transient (see
/// require_transient in initial_conditions.h).
void check_transient(const char* method, const IdData& data, const TransferEstimate& estimate);

/// Squares of one output's simulation error over all experiments, simulated from rest.
double simulation_squares(const IdData& data, const TransferStructure& structure, const VectorView& theta,
                          Index output);

/// Fills fit, loss, noise variances and offsets (none) from structure and theta, for a simulation from rest. lssvf and
/// ivsvf leave it to whoever wants to know: it takes as long as they do.
void measure_fit(TransferEstimate& estimate, const IdData& data);

/// " from input 2 to output 1" for messages, nothing for the only channel.
std::string channel_text(const TransferEstimate& estimate, std::size_t channel);

/// Fills names, models and std from structure, theta and covariance, and warns of poles and zeros that nearly cancel,
/// of parameters that the data hardly determine, of equations that are badly conditioned, and of unstable channels.
void report_errors(TransferEstimate& estimate);

/// The message: a first sentence, then the fit where it was measured, and all warnings.
void set_message(TransferEstimate& estimate, const std::string& first);

}  // namespace dynlab::inline numerics
