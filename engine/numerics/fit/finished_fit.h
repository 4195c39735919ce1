#pragma once
#include <functional>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// The fit that `estimate` makes of `data` by a method for transfer functions in continuous time. With
/// FitOptions::integration `estimate` sees integrated inputs, and its models get an integrator
/// (fit/integrated_input.h); the options that it sees do not ask for one. Throws what `estimate` throws, and
/// InvalidArgument for data or options that do not go with an integrator.
Fit finished_fit(const IdData& data, const FitOptions& options,
                 const std::function<Fit(const IdData&, const FitOptions&)>& estimate);

/// The same of a difference equation, with summed inputs.
Fit finished_discrete_fit(const IdData& data, const FitOptions& options,
                          const std::function<Fit(const IdData&, const FitOptions&)>& estimate);

}  // namespace dynlab::inline numerics
