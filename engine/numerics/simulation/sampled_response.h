#pragma once
#include "numerics/models/frequency_data.h"
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// The sampled outputs (every Ts seconds) of N_i(s)/D(s) exp(-delay s), with one input that is held (zoh) or linearly
/// interpolated (foh) between samples: their responses at exp(i w Ts), exact, a column each. `numerators` has N_i in
/// its rows, the power of D's degree q first; D is monic (q + 1 coefficients); w in rad/s, the delay in seconds. NaN if
/// a pole lies on the point itself.
Eigen::MatrixXcd sampled_responses(const MatrixView& numerators, const VectorView& denominator, const VectorView& w,
                                   double Ts, Hold hold, double delay = 0);

/// The response of a model as it is measured from samples of Ts seconds (Ts = 0: not from samples): that of a
/// continuous-time model as above; with kBandLimited, and of a discrete-time model, frequency_response(). Throws
/// InvalidArgument for a hold with an improper model, and for frequencies (rad/s) that are not finite.
ComplexVector response_between_samples(const TransferFunction& G, const VectorView& w, double Ts,
                                       InterSample inter_sample);

}  // namespace dynlab::inline numerics
