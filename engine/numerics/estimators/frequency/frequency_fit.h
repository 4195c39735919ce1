#pragma once
#include "numerics/estimators/lssvf.h"
#include "numerics/models/frequency_data.h"

namespace dynlab::inline numerics {

/// A continuous-time model B/F exp(-Td s) of a measured frequency response, what srivc and coe give of one:
///     minimize sum_k |G_k - B(i w_k)/F(i w_k) exp(-i w_k Td)|^2/variance_k,
/// the maximum of the likelihood for normal errors that are independent from frequency to frequency; with unknown
/// variances all count alike. Start: Sanathanan and Koerner's iteration in orthogonal polynomials, as it comes and with
/// poles mirrored, for a free delay at the best places of a grid between least_delay and largest_delay (s; default:
/// as far as the frequencies tell delays apart, a quarter of a turn for the nearest two, and at most fifty quarter
/// turns at the middle of the power); then Levenberg-Marquardt with exact sensitivities. Where the input was held
/// between samples, the model's response is that of its samples, exactly. Of the options least_delay, largest_delay,
/// delay_count, max_iterations, extend_iterations, tolerance, stable and cancel count.
///
/// Covariance: (J'J)^-1 with known variances, times the mean square with unknown ones; of a response with several
/// realizations that nonlinear distortion moves, as these move theta. noise_variance is the mean of
/// |error|^2/variance over the degrees of freedom, which is near one where model and variances are right, or that of
/// |error|^2. fit_percent compares the weighted errors with the weighted response about its mean. Told in `warnings`:
/// errors larger than the variances explain, neighbors that share their errors, and what is told of every fit.
/// `method` begins the messages of the InvalidArgument thrown for data as check_frequency_data() refuses them, several
/// channels, and no more frequencies than parameters. References: Pintelon and Schoukens (2012), chapters 9 and 10.
Fit frequency_fit(const std::string& method, const FrequencyData& data, const TransferStructure& structure,
                  const FitOptions& options = {});

/// lssvf of a measured frequency response: minimize sum_k |F(i w_k) G_k - B(i w_k)|^2/(|i w_k + lambda|^(2 n)
/// variance_k). Errors of the response bias it, as they do in the time domain, and a hold is taken off as far as it is
/// known without the model. Standard errors are those of the response's errors alone. Delays are fixed. Throws
/// InvalidArgument as frequency_fit(), and for a cut-off that is not positive.
Fit frequency_lssvf(const FrequencyData& data, const TransferStructure& structure, const SvfOptions& options);

}  // namespace dynlab::inline numerics
