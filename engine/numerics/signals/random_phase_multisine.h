#pragma once
#include "numerics/linalg/types.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

struct RandomPhaseOptions {
    Vector lines;            ///< whole numbers of turns in a period, 1 .. (N - 1)/2; all of them when empty
    bool odd = false;        ///< the odd ones of them alone
    Index detection = 0;     ///< one of every so many lines, drawn, stays without input; 0: none
    double amplitude = 1;    ///< root mean square
    bool low_crest = false;  ///< phases are moved until peaks are low

    /// Throws InvalidArgument naming the option, for a period of N samples.
    void validate(Index period) const;
};

struct RandomPhaseMultisine {
    Vector u;                 ///< one period of N samples
    Vector lines, detection;  ///< with and, of those that were drawn, without input
    double crest = 0;         ///< largest |u| over its root mean square
};

/// One period of a sum of cosines of equal amplitude whose phases come from `phases`, evenly over the circle: one
/// realization; another call gives the next. The detection lines come from a separate random stream, so that all
/// realizations of the same options have the same lines. With many lines the samples are nearly normally distributed,
/// unless peaks are lowered: by clipping and restoring the amplitudes of the lines (Van der Ouderaa, Schoukens and
/// Renneboog 1988). Odd lines with some left out distinguish even from odd distortion (Pintelon and Schoukens 2012,
/// chapter 4). Throws InvalidArgument for a period of fewer than 8 samples, lines that are not whole numbers within the
/// range or occur twice, no line left, groups of fewer than 2 lines, and an amplitude that is not positive.
RandomPhaseMultisine random_phase_multisine(Index period, const RandomPhaseOptions& options, RandomStream& phases);

}  // namespace dynlab::inline numerics
