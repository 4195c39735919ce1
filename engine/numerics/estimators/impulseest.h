#pragma once
#include "numerics/models/impulse_estimate.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

struct ImpulseestOptions {
    Index lags = 0;            ///< n, 1 to 400; the smaller of 70 and N/5 unless given
    bool smooth = true;        ///< prior knowledge that the response is smooth and dies out; else plain least squares
    double confidence = 0.99;  ///< of the test that reads the dead time

    void validate() const;
};

/// Impulse response by regression on past inputs, y(k) = c + sum_{i=0..n} g_i u(k - i) + e(k), over all samples whose n
/// past inputs are recorded; c is estimated for every experiment. Plain least squares is exact without noise when the
/// response is over after n samples, and unbiased when e is white and independent of u. `smooth` adds the prior
/// g ~ N(0, c lambda^max(i, j)) ("tuned/correlated" kernel), whose c, lambda and noise variance maximise the marginal
/// likelihood: it needs no order, and poor inputs are no trouble; its standard errors take the prior for granted. Data:
/// one input, one output, any number of experiments. Throws InvalidArgument for other data, constant signals, fewer
/// than 3 n samples, and, without `smooth`, for an input that does not tell neighbouring samples of the response apart.
/// Reference: Ljung (1999), section 4.3; Chen, Ohlsson and Ljung (2012), On the estimation of transfer functions,
/// regularizations and Gaussian processes - revisited, Automatica 48.
ImpulseEstimate impulseest(const IdData& data, const ImpulseestOptions& options = {});

}  // namespace dynlab::inline numerics
