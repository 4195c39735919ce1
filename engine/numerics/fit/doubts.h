#pragma once
#include <functional>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// How the estimators end: with a fit that users get, its doubts included.

/// The fit that `estimate` makes of `data` by a method for transfer functions in continuous time, with what
/// FitOptions::integration and FitOptions::doubts ask for:
///   integration  `estimate` sees integrated inputs, and its models get an integrator (fit/integrated_input.h);
///   doubts       the option that the fit misses, also as a warning (fit/missed_options.h), unless the start is given,
///                and the assessment of its errors (fit/assessment.h), unless it has a model of its noise.
/// `estimate` sees options that ask for neither. Throws what it throws, and InvalidArgument for data or options that do
/// not go with an integrator.
Fit finished_fit(const IdData& data, const FitOptions& options,
                 const std::function<Fit(const IdData&, const FitOptions&)>& estimate);

/// The same of a difference equation, with summed inputs; a missed option is looked for in fits of the simulation (oe
/// and sriv).
Fit finished_discrete_fit(const IdData& data, const FitOptions& options,
                          const std::function<Fit(const IdData&, const FitOptions&)>& estimate);

/// Assesses the errors of a fit where that is affordable and options.doubts asks for it.
void add_assessment(Fit& fit, const IdData& data, const FitOptions& options);
/// Notes the option that a fit misses, and warns of it.
void add_missed_option(Fit& fit, const std::optional<MissedOption>& missed);

}  // namespace dynlab::inline numerics
