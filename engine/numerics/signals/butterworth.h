#pragma once
#include <limits>
#include <vector>

#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Frequencies in radians per time unit (rad/s): 0 to `high` is a low-pass, `low` to infinity a high-pass filter.
struct PassBand {
    double low = 0, high = std::numeric_limits<double>::infinity();
};

struct FilterOptions {
    int order = 5;            ///< of the low-pass prototype, 1 to 20; filters with two edges have twice as many poles
    bool zero_phase = false;  ///< forwards, then backwards over the signal: no delay, and the magnitude squared
    bool stop = false;        ///< takes the band out instead
    /// Past of the signal, causal filters only: zero, or the value of the first sample. Zero keeps the relation y = G u
    /// of a system that starts at rest; the first sample is for signals around an operating point.
    bool steady_start = false;

    void validate() const;
};

/// (b0 + b1 q^-1 + b2 q^-2)/(1 + a1 q^-1 + a2 q^-2)
struct FilterSection {
    double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
};
using FilterSections = std::vector<FilterSection>;

/// Butterworth filter: |H|^2 = 1/(1 + v^(2n)), where v is w/w_c for a low-pass, w_c/w for a high-pass filter,
/// |w^2 - w_0^2|/(B w) with w_0^2 = low high and B = high - low for a band, after w = tan(w Ts/2) has been put for
/// every frequency (bilinear transform, edges exact). Reference: Oppenheim and Schafer (2010), Discrete-Time Signal
/// Processing, sections 7.2 and B.1. Throws InvalidArgument for edges that do not lie in order between 0 and pi/Ts, no
/// edge at all, or an order outside 1 to 20.
FilterSections butterworth(const PassBand& band, double Ts, const FilterOptions& options = {});

/// H(e^(j w Ts)).
ComplexVector response(const FilterSections& sections, const VectorView& w, double Ts);

/// One signal through all sections, once forwards.
Vector filter_signal(const FilterSections& sections, const VectorView& x, bool steady_start = false);
/// Filters forwards and backwards. The signal is continued at both ends by point reflection, so that levels and slopes
/// pass the ends without a jump.
Vector filter_zero_phase(const FilterSections& sections, const VectorView& x);

/// The same Butterworth filter over all inputs and outputs of all experiments, which leaves the relation between them
/// as it was. Throws as butterworth(), and for irregular sampling.
IdData filter_data(const IdData& data, const PassBand& band, const FilterOptions& options = {});

}  // namespace dynlab::inline numerics
