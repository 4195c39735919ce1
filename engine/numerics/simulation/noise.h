#pragma once
#include "numerics/linalg/types.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

/// Noise v(k) = C(q^-1)/D(q^-1) e(k) with white normal e. C and D hold the weights of the present sample, the one
/// before, ...; both begin with 1.
struct ColoredNoise {
    Vector C = Vector::Ones(1), D = Vector::Ones(1);

    /// std(v)/std(e): the root of the sum of squares of the impulse response of C/D. Throws InvalidArgument unless all
    /// roots of D lie inside the unit circle.
    double gain() const;
    /// `count` samples for e of the standard deviation `sigma`: of the stationary signal, for which e begins so early
    /// that the rest of what came before has decayed to 1e-8. A D with roots on or outside the unit circle has no
    /// stationary signal: then v begins from rest. Throws InvalidArgument for a negative sigma or one that is not
    /// finite.
    Vector draw(Index count, double sigma, RandomStream& random) const;
};

/// The standard deviation of noise that lies `snr` decibels below the noise-free output x, 20 log10(std x/std noise) =
/// snr, as monte_carlo() has it. Throws InvalidArgument for an x that does not change or an snr that is not finite.
double noise_std_of_snr(const VectorView& x, double snr);

}  // namespace dynlab::inline numerics
