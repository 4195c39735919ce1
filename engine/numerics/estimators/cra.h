#pragma once
#include "numerics/models/impulse_estimate.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

struct CraOptions {
    Index lags = 0;            ///< 1 or more; default: the smaller of 70 and N/5
    Index whitening = 10;      ///< order of the autoregressive filter that whitens the input; 0 for none
    double confidence = 0.99;  ///< of the test that reads the dead time

    void validate() const;
};

/// Results of correlation analysis: the impulse response and intermediate results.
struct CorrelationAnalysis {
    ImpulseEstimate impulse;
    Vector whitening_filter;   ///< 1 a_1 .. a_n, applied to input and output
    Vector input_correlation;  ///< of the filtered input, lags 0 .. lags, 1 at lag 0: how white it became
};

/// Correlation analysis: means removed, input and output through the autoregressive filter that makes the input white
/// (Levinson and Durbin on its covariances), then g_i = R_yu(i)/R_u(0), whose standard error under no response is
/// sqrt(R_y(0)/(N R_u(0))). Quick and without structure, but the filtered input of finite length is never quite white,
/// and what is left of its correlation leaks from lag to lag. Data: one input, one output, any number of experiments.
/// Throws InvalidArgument for other data, constant signals, fewer than 3 samples per lag, a negative order. Reference:
/// Ljung (1999), section 6.1; Box, Jenkins and Reinsel (2008), section 12.2.
CorrelationAnalysis cra(const IdData& data, const CraOptions& options = {});

}  // namespace dynlab::inline numerics
