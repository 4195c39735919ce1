#pragma once
#include <cstdint>
#include <string>

#include "base/message.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// What messages call a signal: the input, the output, the reference, or the signal.
enum class SignalName : std::uint8_t { kInput, kOutput, kReference, kSignal };

/// What is wrong with a signal: it has no samples, or one that is NaN or infinite. Empty when nothing is.
Message error_in_samples(SignalName name, const MatrixView& samples);

/// Each throws an InvalidArgument that begins with `caller`, the name of a function, and says in one sentence what was
/// wrong.

/// A signal without samples, or with one that is NaN or infinite.
void check_samples(const std::string& caller, SignalName name, const MatrixView& samples);
/// A channel whose largest sample is neither zero nor between 1e-100 and 1e100, so that sums of squares would fail.
void check_magnitudes(const std::string& caller, SignalName name, const MatrixView& samples);
bool valid_sampling_time(double Ts);
void check_sampling_time(const std::string& caller, double Ts);
/// Instants that are not finite or do not increase strictly.
void check_instants(const std::string& caller, const VectorView& t);

}  // namespace dynlab::inline numerics
