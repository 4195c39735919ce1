#pragma once
#include <functional>
#include <optional>

#include "numerics/models/frequency_data.h"

namespace dynlab::inline numerics {

struct BlaOptions {
    Index period = 0;           ///< samples; must be given
    Index realizations = 1;     ///< in each experiment, one behind the other
    Index transient = 0;        ///< periods left out at the beginning of every realization
    double least_input = 0.01;  ///< lines with less than this part of the largest amplitude count as without input
    std::optional<Index>
        smooth;  ///< variances are means over this many lines on either side; default: chosen automatically
    std::optional<InterSample> inter_sample;  ///< default: from the hold of the data
    std::function<bool()> cancel;             ///< asked before every realization

    void validate() const;
};

/// Best linear approximation of a system from periodic data, and the noise and distortion that hide it: M realizations
/// of a random-phase periodic input (experiments, or pieces of one), P periods of each. With the Fourier coefficients
/// U, Y of the periods and their means over the periods,
///     G_m = Y_m/U_m,   G = mean G_m,
/// the spread over the periods gives the variance of noise (input noise and its correlation with the output included),
/// the spread over the realizations that of noise and of nonlinear distortion, which changes with the phases and not
/// from period to period. Result: response G at the excited lines, `variance` of G (of noise alone where there is one
/// realization), `noise_variance`, `distortion`, and the levels of the output at excited, odd and even lines: without
/// input these show distortion by odd and even powers directly. Levels and distortion are unbiased, so that they may
/// come out below zero where noise hides them. Variances of few values are smoothed over the lines.
///
/// Data: one input, one output, regular sampling, steady state. bla uses complete periods only and leaves out samples
/// at the beginning that fill no period. `warnings` reports these samples, a first period that is not settled, an input
/// that repeats only approximately (leakage), lines that only some realizations excite, and results that one period or
/// one realization cannot determine. Throws InvalidArgument for other data, a period (samples) that is not given or
/// does not fit, a number of realizations that does not divide the data, no period left, an input that does not repeat,
/// and neighboring realizations of one input (shifted in time or not). Reference: Pintelon and Schoukens (2012), System
/// Identification, chapters 3 and 4.
FrequencyData bla(const IdData& data, const BlaOptions& options);

/// Sums over all lines, in units of the output squared: parts of the variance of the output's mean over the P periods.
/// The noise in this mean has one P-th of its power in the data. NaN for parts that are not known.
struct LevelSums {
    double power = 0, noise = 0, distortion = 0;
};
LevelSums level_sums(const FrequencyData& data);

}  // namespace dynlab::inline numerics
