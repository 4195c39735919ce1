#pragma once
#include <string>
#include <vector>

#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Names of a continuous-time system's parameters: a1 .. an, b0 .. bm, and Td when it has a delay.
std::vector<std::string> system_parameter_names(const TransferFunction& system);

/// Values of the system's parameters for the names a1 .. an, b0 .. bm (and Td) of a model with as many poles and at
/// least as many zeros, whose leading coefficients are zero then; empty for any other names.
Vector true_parameters(const TransferFunction& system, const std::vector<std::string>& names);

/// The Cramer-Rao bound sigma^2 (sum psi psi')^-1 for white Gaussian noise of standard deviation `sigma` on the output
/// (Ljung 1999, section 7.4), psi the exact sensitivities of the true system's output to the named parameters: the
/// covariance that no unbiased method can beat. `u` has N samples every Ts seconds, the state is zero at the first.
/// Infinite variances if the input does not determine the parameters. Throws InvalidArgument for names that
/// true_parameters() does not know, fewer samples than parameters, an improper system, and an unknown delay of a system
/// with as many zeros as poles.
Matrix cramer_rao_bound(const TransferFunction& system, const VectorView& u, double Ts, Hold hold, double sigma,
                        const std::vector<std::string>& names);

}  // namespace dynlab::inline numerics
