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
/// past inputs are recorded; c is estimated for every experiment. Plain least squares is exact without noise when the
/// response is over after n samples, and unbiased when e is white and independent of u. `smooth` adds a prior
/// g ~ N(0, c K), whose c, shape and noise variance maximise the marginal likelihood (criteria/response_prior.h): it
/// needs no order, and poor inputs are no trouble; its standard errors take the prior for granted. All of it follows
/// from Phi'Phi, whose lags are running sums, so that a long record costs little. Data:
/// one input, one output, any number of experiments. Throws InvalidArgument for other data, constant signals, fewer
/// than 3 n samples, and, without `smooth`, for an input that does not tell neighboring samples of the response apart.
/// Reference: Ljung (1999), section 4.3; Chen, Ohlsson and Ljung (2012), On the estimation of transfer functions,
/// regularizations and Gaussian processes - revisited, Automatica 48; Chen and Ljung (2013), Implementation of
/// algorithms for tuning parameters in regularized least squares problems in system identification, Automatica 49.
RegressedResponse impulseest(const IdData& data, const ImpulseestOptions& options = {});

}  // namespace dynlab::inline numerics
