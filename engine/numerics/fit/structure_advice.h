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
    kHold,         ///< straight lines between the samples of an input that is held in the fit
    kLate,         ///< nothing, but the input was logged one sample late
    kLine,         ///< none of these: a straight line lies in the output, a drift or the ramp of a loaded integrator
};

/// A better structure, and the fit that it leads to.
struct StructureAdvice {
    StructureAdviceCode code = StructureAdviceCode::kPole;
    std::string option;       ///< of the structure: "delay" (s), "poles" or "zeros"; "hold", "detrend", "shift"
    double value = 0;         ///< to ask for
    std::string output = {};  ///< name of the output whose fit rises, where there are several
    Index samples = 0;        ///< of a long record: of its beginning, which both fits are of; 0 for all
    double fit_percent = 0;   ///< as it is; -infinity where the model's simulation overflows
    double better_fit_percent = 0;
};

/// Whether inputs that count as held move at nearly every sample, as measured ones do.
bool moves_between_samples(const IdData& data);

/// Whether the input one sample earlier explains a record of one input and one output better than a model of so many
/// poles with this mean square error, by strong evidence; better than straight lines between the samples of an input
/// that moves at nearly every one, and as well as a direct feedthrough of as few poles. Not for irregular sampling and
/// above 100,000 samples.
bool late_input(const IdData& data, int poles, double loss);

/// The structure that an output-error fit in continuous time misses, or nothing: a direct feedthrough where it has
/// fewer zeros than poles; with one input, one more pole, or a delay where the fit has a fixed one.
///
/// Where the errors wander (statistics/wandering.h), a straight line comes first: the structure is fitted to the data
/// without their lines, and nothing else is looked for where that gains; then, where a fit without a delay leaves
/// errors that follow the input, an input that was logged late (late_input). A feedthrough is fitted where a LOOK AHEAD
/// on the first 3000 samples at most promises it: J'J and J'e of the sensitivities at the fit, extended by the further
/// coefficients of B, tell what one Gauss-Newton step gains. A pole and a delay are fitted where the errors follow the
/// input. Each is fitted by the options of the fit, which choose its start again where they leave it open (of records
/// above 100,000 samples, to their beginning). A gain counts when it lowers BIC by more than 10, very strong evidence
/// (Kass and Raftery 1995), with as many samples as white errors of the same power at low frequencies would have: N (1
/// - r)/(1 + r), r the errors' correlation from one sample to the next; and when it is half a point of fit, or a fifth
/// of what the fit lacks. A feedthrough must gain over n - 1 zeros, and one more pole must not do as well; where an
/// input that moves at nearly every sample does as well when it is not held, kHold takes its place.
///
/// `data` and `options`: as the search was given them, with integrated inputs where it had an integrator
/// (options.integration; no feedthrough is looked for then). Nothing for canceled fits, those with an operating point
/// removed, and where outputs share a denominator.
std::optional<StructureAdvice> missed_structure(const IdData& data, const Fit& fit, const FitOptions& options);

/// "With one more pole the fit is 88.1 % instead of 66.2 %: ..."
Message sentence_of(const StructureAdvice& missed);

}  // namespace dynlab::inline numerics
