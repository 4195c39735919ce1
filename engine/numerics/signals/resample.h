#pragma once
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// The signal at `up`/`down` times its sampling rate: sample m is at the old sample m down/up, and the last one is not
/// beyond the old last one. A linear-phase low-pass filter (Kaiser window, 100 dB) removes frequencies that the lower
/// of the two rates cannot represent: a sine below 80 % of half that rate is kept to within 2e-5 of its amplitude, and
/// of one above half that rate at most this part remains. A constant stays exact. Within kResampleReach samples of the
/// lower rate from the ends, where the signal is continued by point reflection, the result is less exact. `up` and
/// `down` are reduced by their common divisor. Throws InvalidArgument unless 1 <= up, down <= 1000. Reference:
/// Oppenheim and Schafer (2010), sections 4.6 and 7.5.
Vector resample_signal(const VectorView& x, Index up, Index down);

inline constexpr Index kResampleReach = 32;

/// All signals of all experiments, filtered alike, with the new sampling time Ts down/up. Throws InvalidArgument for
/// irregular sampling and when fewer than two samples would be left.
IdData resample(const IdData& data, Index up, Index down);

}  // namespace dynlab::inline numerics
