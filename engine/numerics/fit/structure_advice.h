#pragma once
#include <optional>
#include <string>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// What a structure lacks.
enum class StructureAdviceCode {
    kDelay,        ///< a delay, where the structure fixes it
    kPole,         ///< one more pole
    kFeedthrough,  ///< a direct term: as many zeros as poles
    kHold,         ///< linear interpolation of an input that is held in the fit
    kLate,         ///< nothing, but the input was logged one sample late
    kLine,         ///< none of these: a straight line lies in the output, a drift or the ramp of a loaded integrator
};

/// A better structure, and the fit that it leads to.
struct StructureAdvice {
    StructureAdviceCode code = StructureAdviceCode::kPole;
    std::string option;       ///< of the structure: "delay" (s), "poles" or "zeros"; "hold", "detrend", "shift"
    double value = 0;         ///< to ask for
    std::string output = {};  ///< name of the output whose fit rises, where there are several
    Index samples = 0;        ///< of long data: number of first samples, which both fits use; 0 for all
    double fit_percent = 0;   ///< as it is; -infinity where the model's simulation overflows
    double better_fit_percent = 0;
};

/// Whether inputs that count as held move at nearly every sample, as measured ones do.
bool moves_between_samples(const IdData& data);

/// Whether the input one sample earlier explains data of one input and one output better than a model of `poles` poles
/// with this mean square error, by strong evidence. It must also be better than linear interpolation of an input that
/// changes at nearly every sample, and as good as a direct feedthrough with the same number of poles. False for
/// irregular sampling and for more than 100,000 samples.
bool late_input(const IdData& data, int poles, double loss);

/// The structure that an output-error fit in continuous time misses, or no value: a direct feedthrough if it has fewer
/// zeros than poles; with one input, one more pole, or a delay if the fit has a fixed one.
///
/// If the errors wander (statistics/wandering.h), a straight line is tested first: the structure is fitted to the
/// detrended data, and if that improves the fit, nothing else is tested. If a fit without a delay leaves errors that
/// follow the input, a late log of the input is tested next (late_input). A feedthrough is fitted if a LOOK AHEAD on at
/// most the first 3000 samples predicts an improvement: J'J and J'e of the sensitivities at the fit, extended by the
/// additional coefficients of B, predict the gain of one Gauss-Newton step. A pole and a delay are fitted if the errors
/// follow the input. Each structure is fitted with the options of the fit, which select its start again if the options
/// do not specify it (for more than 100,000 samples, to the first samples). A gain counts if it lowers BIC by more than
/// 10, very strong evidence (Kass and Raftery 1995). BIC uses as many samples as white errors of the same power at low
/// frequencies would have: N (1 - r)/(1 + r), r the errors' correlation from one sample to the next. The gain must also
/// be half a point of fit, or a fifth of the missing fit. A feedthrough must improve on n - 1 zeros, and be better than
/// one more pole. If linear interpolation of an input that changes at nearly every sample is as good, kHold is
/// returned.
///
/// `data` and `options`: those of the search, with integrated inputs if the search had an integrator
/// (options.integration; no feedthrough is tested then). No value for canceled fits, fits with an operating point
/// removed, and outputs that share a denominator.
std::optional<StructureAdvice> missed_structure(const IdData& data, const Fit& fit, const FitOptions& options);

/// "With one more pole the fit is 88.1 % instead of 66.2 %: ..."
Message sentence_of(const StructureAdvice& missed);

}  // namespace dynlab::inline numerics
