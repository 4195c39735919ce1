#pragma once
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// The signal at `up`/`down` times its sampling rate: sample m stands at the old sample m down/up, and the last one not
/// beyond the old last. A linear-phase low-pass filter (Kaiser window, 100 dB) takes out what the lower of the two
/// rates cannot carry: a sine below 80 % of that rate's half is kept to within 2e-5 of its amplitude, one above the
/// half leaves no more than that. A constant stays exact. Within kResampleReach samples of the lower rate from the
/// ends, where the signal is continued by point reflection, the result is less exact. Numbers are reduced by their
/// common divisor. Reference: Oppenheim and Schafer (2010), sections 4.6 and 7.5. Throws InvalidArgument unless 1 <=
/// up, down
/// <= 1000.
Vector resample_signal(const VectorView& x, Index up, Index down);

inline constexpr Index kResampleReach = 32;

/// All signals of all experiments, filtered alike, with the new sampling time Ts down/up. Throws InvalidArgument for
/// irregular sampling and when fewer than two samples would be left.
IdData resample(const IdData& data, Index up, Index down);

}  // namespace dynlab::inline numerics
