#pragma once
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/models/frequency_data.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// A frequency response that comes from the data alone, without a model of finite order.
struct SpectralEstimate {
    Vector w;                ///< rad per time unit, increasing, at most pi/Ts
    ComplexVector response;  ///< G(e^(j w Ts)) at each w
    Vector std;        ///< of its real part; of its imaginary one as much, or near 0 and pi/Ts less; empty when one
                       ///< value is all there is per w
    Vector coherence;  ///< 0 to 1: part of the output's power that the input explains; empty like std
    Vector
        noise_spectrum;  ///< Phi_v(w), power per sample (its mean over -pi..pi is the noise variance); empty like std
    Message message;
    std::vector<Message> warnings;
};

/// The estimate as a measured response, which models are fitted to; `smoothed`: over the frequencies, so that
/// neighbors share their errors. `method` is the one that gave it, `data` what it was given.
/// Variances of 0 become the largest variance; without positive variances, the result has none.
FrequencyData frequency_data_of(const SpectralEstimate& estimate, const IdData& data, const std::string& method,
                                bool smoothed);

/// What these methods can work on: one input, one output, regular sampling, at least `min_samples` samples in every
/// experiment, neither signal constant. Throws InvalidArgument that begins with `caller` and says what to do. Returns
/// the data with the mean of every experiment removed when that is wanted.
IdData nonparametric_data(const std::string& caller, const IdData& data, Index min_samples, bool remove_means);

/// Turns averaged (cross) spectra at one frequency into response, spread, coherence and noise. `averages` is the number
/// of independent values that went into each of them, `real_share` the part of the response's variance that its real
/// part has: one half where its neighbors are all different frequencies; more near 0 and pi/Ts, where the averages
/// hold values and their conjugates; all of it at these two, where the response is real.
struct SpectralPoint {
    Complex response;
    double std, coherence, noise;
};
SpectralPoint spectral_point(double input, double output, Complex cross, double averages, double real_share);

}  // namespace dynlab::inline numerics
