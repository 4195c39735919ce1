#pragma once
#include <vector>

#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

enum class TrendKind { kConstant, kLinear };

/// What was taken from one experiment: channel i loses offset_i + slope_i (t - start_time), slopes in units per
/// time unit.
struct Trend {
    Vector output_offset, output_slope, input_offset, input_slope, reference_offset = {}, reference_slope = {};
};

struct Detrended {
    IdData data;
    std::vector<Trend> removed;  ///< one per experiment
};

/// Removes from every channel of every experiment its mean, or the straight line that fits it best in the least
/// squares sense (over the true instants, when sampling is irregular). A line needs two samples.
Detrended detrend(const IdData& data, TrendKind kind);
inline Detrended remove_mean(const IdData& data) {
    return detrend(data, TrendKind::kConstant);
}

/// Removes from every channel its mean over the stretch before anything happens, so that the record starts from rest at
/// zero: the first `samples` samples, or, when that is 0, those over which every input stays within 5 % of its range of
/// its first value. Throws InvalidArgument when that stretch is shorter than three samples, for `samples` beyond an
/// experiment, and for data without inputs unless `samples` is given.
Detrended remove_initial_level(const IdData& data, Index samples = 0);

}  // namespace dynlab::inline numerics
