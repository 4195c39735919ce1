#pragma once
#include "numerics/fit/transfer_estimate.h"

namespace dynlab::inline numerics {

/// Simplified refined instrumental variables for continuous-time models, for the COE structure
///     y_i = sum_j B_ij(p)/F_ij(p) u_j(t - delay_ij) + e_i,  e white.
/// From a first estimate (lssvf at options.lambda, or at the best of several cut-off frequencies) each pass filters all
/// signals with 1/F of the pass before and solves the normal equations with the exact sensitivities of the simulated
/// output as instruments; unstable poles are mirrored. With the exact instruments the fixed point is the output-error
/// optimum in finite samples (see coe), so the estimate is efficient for white noise and consistent for any noise
/// independent of the inputs. Covariance noise_variance (Z'Z)^-1.
/// Several inputs, each with its denominator, by back-fitting; several outputs and experiments; regular or irregular
/// sampling; inputs and delays exactly as the data's hold says. Where delays are free, an initial state or offset is
/// estimated, or denominators differ within an output, the passes give the start of a joint Gauss-Newton refinement of
/// the same criterion, and that refinement is tried as well where the passes do not settle. Non-convergence and
/// doubtful results are told in `warnings`. Throws InvalidArgument for unsuitable data (check_transfer_data) or
/// options. References: Young and Jakeman (1980); Young, Garnier and Gilson in Garnier and Wang (2008), chapter 4.
TransferEstimate srivc(const IdData& data, const TransferStructure& structure, const TransferOptions& options = {});

}  // namespace dynlab::inline numerics
