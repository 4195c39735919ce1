#pragma once
#include "numerics/linalg/types.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

/// Input signals for experiments. Frequencies in hertz, times in seconds; the samples are at 0, Ts, 2 Ts, ..., and a
/// signal of `duration` T contains round(T/Ts) of them. All functions throw InvalidArgument for sizes or times that are
/// not positive and for frequencies below zero or above half the sampling frequency.

/// `low`, and from sample `first` (1-based, 1..count + 1) on `high`.
Vector step_signal(Index count, Index first = 1, double low = 0, double high = 1);

/// amplitude sin(2 pi frequency t + phase), phase in rad.
Vector sine(double frequency, double duration, double Ts, double amplitude = 1, double phase = 0);

enum class ChirpShape { kSine, kSquare };
/// A sine whose frequency runs linearly from `start_frequency` at time 0 to `end_frequency` at `duration`, or its
/// sign (+1 where the sine is zero).
Vector chirp(double start_frequency, double end_frequency, double duration, double Ts,
             ChirpShape shape = ChirpShape::kSine);

/// Sum of cosines of equal amplitude and root mean square one, with Schroeder's phases -pi k (k - 1)/F, which keep the
/// peaks low (Schroeder 1970). Throws when a frequency
/// occurs twice.
Vector multisine(const VectorView& frequencies, double duration, double Ts);

/// Random binary signal: every `hold` samples a fair coin from `random` decides between `low` and `high`.
Vector rbs(Index count, int hold, RandomStream& random, double low = -1, double high = 1);

}  // namespace dynlab::inline numerics
