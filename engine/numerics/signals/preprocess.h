#pragma once
#include <utility>

#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

enum class TrendKind { kConstant, kLinear };

/// Removes from every channel of every experiment its mean, or the straight line that fits it best in the least
/// squares sense (over the true instants, when sampling is irregular). A line needs two samples.
IdData detrend(IdData data, TrendKind kind);
inline IdData remove_mean(IdData data) {
    return detrend(std::move(data), TrendKind::kConstant);
}

/// Removes from every channel its mean over the initial range at rest, so that the data start from rest at zero. The
/// range is the first `samples` samples, or, if that is 0, those over which every input stays within 5 % of its range
/// of its first value. Throws InvalidArgument if the range is shorter than three samples, for `samples` beyond an
/// experiment, and for data without inputs unless `samples` is given.
IdData remove_initial_level(IdData data, Index samples = 0);

}  // namespace dynlab::inline numerics
