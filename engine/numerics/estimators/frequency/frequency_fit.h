#pragma once
#include "numerics/estimators/lssvf.h"
#include "numerics/models/frequency_data.h"

namespace dynlab::inline numerics {

/// Estimates a continuous-time model B/F exp(-Td s) from a measured frequency response, as srivc and coe do for such
/// data:
///     minimize sum_k |G_k - B(i w_k)/F(i w_k) exp(-i w_k Td)|^2/variance_k,
/// the maximum of the likelihood for normal errors that are independent between frequencies; with unknown variances all
/// frequencies have equal weight. Start: Sanathanan and Koerner's iteration in orthogonal polynomials, unchanged and
/// with poles mirrored. For a free delay the iteration runs at the best points of a grid between least_delay and
/// largest_delay (s; default: the range in which the frequencies distinguish delays, a quarter of a turn for the
/// nearest two, and at most fifty quarter turns at the middle of the power). Levenberg-Marquardt with exact
/// sensitivities follows. If the input is held between samples, the model's response is exactly that of its samples.
/// The options least_delay, largest_delay, delay_count, max_iterations, extend_iterations, tolerance, stable and cancel
/// are used.
///
/// Covariance: (J'J)^-1 with known variances, times the mean square with unknown ones; of a response with several
/// realizations that nonlinear distortion moves, as these move theta. noise_variance is the mean of |error|^2/variance
/// over the degrees of freedom, which is near one where model and variances are right, or that of |error|^2.
/// fit_percent compares the weighted errors with the weighted response about its mean. `warnings` reports errors larger
/// than the variances explain, correlated errors of neighboring frequencies, and the issues that apply to every fit.
/// `method` begins the messages of the InvalidArgument thrown for data as check_frequency_data() refuses them, several
/// channels, and no more frequencies than parameters. References: Pintelon and Schoukens (2012), chapters 9 and 10.
Fit frequency_fit(const std::string& method, const FrequencyData& data, const TransferStructure& structure,
                  const FitOptions& options = {});

/// lssvf of a measured frequency response: minimize sum_k |F(i w_k) G_k - B(i w_k)|^2/(|i w_k + lambda|^(2 n)
/// variance_k). Errors of the response bias the estimate, as in the time domain. The effect of a hold is removed to the
/// extent that it is known without the model. Standard errors are those of the response's errors alone. Delays are
/// fixed. Throws InvalidArgument as frequency_fit(), and for a cut-off that is not positive.
Fit frequency_lssvf(const FrequencyData& data, const TransferStructure& structure, const SvfOptions& options);

}  // namespace dynlab::inline numerics
