#pragma once
#include "numerics/fit/spectral_estimate.h"

namespace dynlab::inline numerics {

struct EtfeOptions {
    Index smooth = 0;           ///< Hann weights over this many frequencies on either side; 0 leaves the raw ratio
    bool remove_mean = true;    ///< of both signals first
    double least_input = 1e-3;  ///< frequencies where |U| is below this part of its largest value are left out

    void validate() const;
};

/// Empirical transfer function estimate G(w_k) = Y(w_k)/U(w_k), the ratio of the discrete Fourier transforms at w_k = 2
/// pi k/(N Ts), k = 1 .. N/2. For a periodic input whose period divides N, in steady state, it is unbiased, and exact
/// without noise; for other inputs the ends of the data add an error that falls with N. Its variance does not fall with
/// N: noise spectrum over input power. With `smooth` m it is the ratio of weighted means of Y conj(U) and |U|^2 over 2
/// m + 1 frequencies. Its variance falls with m, but peaks narrower than m lines are flattened. In this case etfe also
/// returns standard errors, coherence and noise spectrum. Data: one input, one output, one experiment. Throws
/// InvalidArgument for other data, fewer than 8 samples, constant signals, and options out of range. Reference: Ljung
/// (1999), sections 6.3 and 6.4.
SpectralEstimate etfe(const IdData& data, const EtfeOptions& options = {});

}  // namespace dynlab::inline numerics
