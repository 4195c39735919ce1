#pragma once
#include "numerics/fit/transfer_search.h"

namespace dynlab::inline numerics {

/// Simplified refined instrumental variables for continuous-time models, for the COE structure
///     y_i = sum_j B_ij(p)/F_ij(p) u_j(t - delay_ij) + e_i,  e white.
/// From a first estimate (lssvf at options.lambda, or at the best of several cutoff frequencies) each pass filters all
/// signals with 1/F of the pass before and solves the normal equations with the exact sensitivities of the simulated
/// output as instruments; unstable poles are mirrored. With the exact instruments the fixed point is the output-error
/// optimum in finite samples (see coe), so the estimate is efficient for white noise and consistent for any noise
/// independent of the inputs. Covariance noise_variance (Z'Z)^-1.
/// Several inputs, outputs and experiments; regular or irregular sampling; inputs and delays exactly as the data's hold
/// says.
///
/// THE PASSES GIVE THE WHOLE ANSWER only for fixed delays, a start from rest without offset, and one denominator for
/// each output. With a free delay, an estimated or steady initial state, an offset, or inputs with separate
/// denominators the passes provide only a start. The estimate is then one Levenberg-Marquardt search of the output
/// error over all parameters, the same search as coe (fit/transfer_search.h), with the same result. If the passes do
/// not settle, srivc also tries that search, and returns its end if the loss is lower. IF THE OPTIONS DO NOT SPECIFY
/// THE START ("auto", the default), srivc keeps the fit from rest without offset unless the data indicate that another
/// start is better (fit/start_choice.h); the message names the selected start. `warnings` reports non-convergence and
/// doubtful results; diagnose() computes the rest (fit/diagnostics.h). Throws InvalidArgument for unsuitable data
/// (check_transfer_data) or options. References: Young and Jakeman (1980); Young, Garnier and Gilson in Garnier and
/// Wang (2008), chapter 4. `aids`: what is known already.
Fit srivc(const IdData& data, const TransferStructure& structure, const FitOptions& options = {},
          const SearchAids& aids = {});

/// The passes alone, from their first estimate to where they settle or end. Throws InvalidArgument for unsuitable data.
Fit srivc_by_passes(const IdData& data, const TransferStructure& structure, const FitOptions& options);

/// The estimate of the passes, or the end of a search of the output error over all parameters (search_transfer) if it
/// lies lower. The search is made where the passes may have ended in a bad minimum: they did not settle, explain
/// little, leave errors that follow the input, or gain nothing over a model with fewer poles or zeros.
Fit search_where_passes_fail(Fit estimate, const IdData& data, const FitOptions& options, const SearchAids& aids);

/// Whether they give the whole answer: fixed delays, a start from rest without offset, one denominator for each output,
/// no fixed parameters and no weights.
bool srivc_passes_suffice(const TransferStructure& structure, const FitOptions& options);

}  // namespace dynlab::inline numerics
