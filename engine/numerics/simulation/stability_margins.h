#pragma once
#include <vector>

#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// How far the open loop L(jw) is from -1 where it crosses the negative real axis or the unit circle.
struct StabilityMargins {
    struct Crossover {
        double frequency;  ///< rad/s
        double margin;
    };
    std::vector<Crossover> gains;   ///< L real and negative: the factor 1/|L| to -1
    std::vector<Crossover> phases;  ///< |L| = 1: the angle to -1, degrees in (-180, 180]; negative beyond it

    /// The smallest of them: nearest to a factor of one, and to zero degrees. Without a crossover an infinite margin at
    /// frequency NaN.
    double gain_margin, gain_frequency;    ///< frequency in rad/s
    double phase_margin, phase_frequency;  ///< degrees; rad/s
    /// s: how much more delay the loop bears, the least of (phase margin, counted from 0 to 360 degrees)/frequency over
    /// all crossovers of the unit circle.
    double delay_margin;
};

/// Of the loop that G closes with negative unit feedback, its delay included; discrete models up to pi/Ts. The
/// frequency axis is searched from far below the lowest corner frequency to far above the highest one and the last
/// crossover of the unit circle, so finely that no turn of the delay and no resonance is missed, and each crossover is
/// then found to rounding by bisection. With a delay there are infinitely many crossovers of the real axis: those far
/// beyond the last one of the unit circle, where |L| falls, are left out. Reference: Astrom and Murray (2021),
/// section 10.3.
StabilityMargins stability_margins(const TransferFunction& G);

}  // namespace dynlab::inline numerics
