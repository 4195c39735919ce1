#pragma once
#include <functional>
#include <optional>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// What an output-error fit by the default options (from rest at zero input, no offset) misses: the option that raises
/// the fit and the fit it leads to, or nothing. Looked for are a constant, a start that is not from rest, both, and a
/// direct feedthrough, i.e. as many zeros as poles where the structure has fewer.
///
/// FIRST A LOOK AHEAD on the first 3000 samples at most: the sums J'J and J'e of the sensitivities at the fit,
/// extended by a constant, the free motions of 1/A and the further coefficients of B, tell what one Gauss-Newton step
/// gains with each of them (d'g, (J'J) d = g = J'e). Only what promises a gain that counts is fitted, by the
/// search that the option leads to (fit/transfer_search.h; of records above 100,000 samples on their beginning). A gain
/// counts when it lowers BIC by more than 10, very strong evidence (Kass and Raftery 1995), with as many samples as
/// white errors of the same power at low frequencies would have: N (1 - r)/(1 + r), r the errors' correlation from
/// one sample to the next; and when it is half a point of fit, or a fifth of what the fit lacks. Of what counts, that
/// with the fewest values is told to which no other adds such a gain. A feedthrough must gain over n - 1 zeros, and one
/// more pole must not do as well. Next to an integrator (FitOptions::integration) no feedthrough is looked for.
///
/// `data`, `fit` and `options`: as the search was given them and gave it. Nothing for fits by other options, for
/// cancelled ones, and where outputs share a denominator.
std::optional<MissedOption> missed_option(const IdData& data, const Fit& fit, const FitOptions& options);

/// The same of a model of difference equations that oe or sriv found by the defaults: a constant and a start. The look
/// ahead is by least squares of the errors on the sensitivities, of up to 3000 samples; `again` fits the data with
/// other options.
std::optional<MissedOption> missed_discrete_option(const IdData& data, const Fit& fit, const FitOptions& options,
                                                   const std::function<Fit(const FitOptions&)>& again);

/// "With `offset` = "estimate" the fit is 88.1 % instead of 66.2 %: the output stands on a constant ..."
Message sentence_of(const MissedOption& missed);

}  // namespace dynlab::inline numerics
