#pragma once
#include "numerics/fit/polynomial_estimate.h"
#include "numerics/fit/transfer_estimate.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// A model with an integrator, B/(p F) u, is B/F of the integrated input, which for a held input runs on straight
/// lines: an estimation from these data, followed by append_integrator(), is exact. Inputs become their integrals from
/// each experiment's first sample on. Throws InvalidArgument unless inputs are held (zoh).
IdData integrated_inputs(const IdData& data);
/// Models B/F become B/(p F); theta, its covariance and the fits stay as they are.
void append_integrator(TransferEstimate& estimate);

/// The same in discrete time: B/F of the running sum of the inputs is B/((1 - q^-1) F) of the inputs.
IdData summed_inputs(const IdData& data);
void append_integrator(PolynomialEstimate& estimate);

}  // namespace dynlab::inline numerics
