#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// A model with an integrator, B/(p F) u, is B/F of the integrated input, which for a held input runs on straight
/// lines: an estimation from these data, followed by append_integrator(), is exact. Inputs become their integrals from
/// each experiment's first sample on. Throws InvalidArgument unless inputs are held (zoh).
IdData integrated_inputs(const IdData& data);

/// The same in discrete time: B/F of the running sum of the inputs is B/((1 - q^-1) F) of the inputs.
IdData summed_inputs(const IdData& data);

/// Options for estimations from such data: what an integrator held before a record is a constant of its output, so that
/// with a start that is estimated, or chosen, the constant is, too. Throws InvalidArgument for offset "remove": an
/// integrator rests at no operating point.
FitOptions options_with_integrator(FitOptions options);

/// The models of a fit to such data, B/F, become B/(p F) or B/((1 - q^-1) F); theta, its covariance and the fit stay
/// as they are.
void append_integrator(Fit& fit);

}  // namespace dynlab::inline numerics
