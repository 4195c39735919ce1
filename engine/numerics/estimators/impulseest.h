#pragma once
#include <optional>

#include "numerics/criteria/response_prior.h"
#include "numerics/models/impulse_estimate.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

struct ImpulseestOptions {
    Index lags = 0;      ///< n, 1 to 400; default: the smaller of 70 and N/5
    bool smooth = true;  ///< prior knowledge that the response is smooth and dies out; else plain least squares
    ResponseKernel kernel = ResponseKernel::kTc;  ///< of the prior
    double confidence = 0.99;                     ///< of the test that reads the dead time

    void validate() const;
};

/// With the prior that a smooth estimate was made with, and its scale c.
struct RegressedResponse : ImpulseEstimate {
    std::optional<ResponsePrior> prior;
    double prior_scale = 0;  ///< square of the response's unit
};

/// Impulse response by regression on past inputs, y(k) = c + sum_{i=0..n} g_i u(k - i) + e(k), over all samples whose n
/// past inputs are in the data; c is estimated for every experiment. Plain least squares is exact without noise if the
/// response ends within n samples, and unbiased if e is white and independent of u. `smooth` adds a prior g ~
/// N(0, c K), whose c, shape and noise variance maximize the marginal likelihood (criteria/response_prior.h). With
/// `smooth` no order is needed, and poorly exciting inputs are allowed; the standard errors assume that the prior is
/// correct. All results follow from Phi'Phi, whose lags are running sums, so that long data cost little. Data: one
/// input, one output, any number of experiments. Throws InvalidArgument for other data, constant signals, fewer than 3
/// n samples, and, without `smooth`, for an input that does not determine neighboring samples of the response.
/// References: Ljung (1999), section 4.3; Chen, Ohlsson and Ljung (2012), On the estimation of transfer functions,
/// regularizations and Gaussian processes - revisited, Automatica 48; Chen and Ljung (2013), Implementation of
/// algorithms for tuning parameters in regularized least squares problems in system identification, Automatica 49.
RegressedResponse impulseest(const IdData& data, const ImpulseestOptions& options = {});

}  // namespace dynlab::inline numerics
