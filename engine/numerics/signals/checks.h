#pragma once
#include <string>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Each throws an InvalidArgument that begins with `caller` and says in one sentence what was wrong.

/// A signal without samples, or with one that is NaN or infinite; `name` is what messages call it ("the input").
void check_samples(const std::string& caller, const std::string& name, const MatrixView& samples);
/// A channel whose largest sample is neither zero nor between 1e-100 and 1e100, so that sums of squares would fail.
void check_magnitudes(const std::string& caller, const std::string& name, const MatrixView& samples);
void check_sampling_time(const std::string& caller, double Ts);
/// Instants that are not finite or do not increase strictly.
void check_instants(const std::string& caller, const VectorView& t);

}  // namespace dynlab::inline numerics
