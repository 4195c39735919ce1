#pragma once
#include <vector>

#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Frequencies (rad per time unit) at which the output that follows the input has peaks, the highest peak first,
/// `max_count` at most: local maxima of |S_uy|^2/S_uu, spectra of the first input and the first output averaged over
/// half overlapping segments (Welch 1967) of all experiments. Nothing for irregular sampling and for short data.
std::vector<double> response_peaks(const IdData& data, std::size_t max_count);

}  // namespace dynlab::inline numerics
