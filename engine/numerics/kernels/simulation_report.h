#pragma once
#include "numerics/kernels/denominator_group.h"
#include "numerics/kernels/transfer_estimate.h"

namespace dynlab {

/// Throw InvalidArgument, which begins with the method's name: data without inputs, of other channels than the
/// structure, with fewer than 3 samples per parameter, with an input that is zero throughout (or constant although the
/// output does not start from rest, so that it is no step), or with an output that never changes.
void check_transfer_data(const char* method, const IdData& data, const TransferStructure& structure);

/// Squares of one output's simulation error over all experiments, simulated from rest.
double simulation_squares(const IdData& data, const TransferStructure& structure, const VectorView& theta,
                          Index output);

/// Fills names, models, fit, loss and noise variances from structure and theta, for a simulation from rest.
void measure_fit(TransferEstimate& estimate, const IdData& data);

/// Fills std from the covariance, and warns of poles and zeros that nearly cancel, of parameters that the data hardly
/// determine, and of equations that are badly conditioned.
void report_errors(TransferEstimate& estimate);

/// The message: a first sentence, then the fit and all warnings.
void set_message(TransferEstimate& estimate, const std::string& first);

}  // namespace dynlab
