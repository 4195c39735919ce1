#pragma once
#include "numerics/fit/spectral_estimate.h"

namespace dynlab::inline numerics {

struct SpaOptions {
    Index window = 0;         ///< M, largest lag used; default: min(N/10, 30)
    Vector w;                 ///< rad per time unit; default: 128 values between 1/(M Ts) and pi/Ts
    bool remove_mean = true;  ///< of both signals first, experiment by experiment

    void validate() const;
};

/// Spectral analysis after Blackman and Tukey: covariances R_yu, R_u, R_y (sums over all experiments, divided by the
/// number of samples) times a Hann lag window 0.5 (1 + cos(pi tau/M)), transformed to spectra, and
///     G = Phi_yu/Phi_u,   Phi_v = (Phi_y - |Phi_yu|^2/Phi_u) K/(K - 1),   var Re G = var Im G = Phi_v/(2 K Phi_u),
/// with K = N/(0.75 M) independent values in every average (double variance at 0 and pi/Ts). Features narrower than
/// about pi/(M Ts) rad/s are flattened (bias); the variance grows with M. The open-loop response is found: with
/// feedback the estimate is biased. Data: one input, one output, any number of experiments. Throws InvalidArgument for
/// other data, fewer than 8 samples, constant signals, M outside 2 to N - 1, frequencies outside 0 to pi/Ts. Reference:
/// Ljung (1999), sections 6.4 and 6.5.
SpectralEstimate spa(const IdData& data, const SpaOptions& options = {});

}  // namespace dynlab::inline numerics
