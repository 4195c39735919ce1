#include "numerics/fit/finished_fit.h"

#include "numerics/fit/integrated_input.h"

namespace dynlab::inline numerics {

namespace {

using Estimation = std::function<Fit(const IdData&, const FitOptions&)>;

Fit finished(const IdData& data, const FitOptions& options, IdData (*integrate)(const IdData&),
             const Estimation& estimate) {
    if (!options.integration) return estimate(data, options);
    FitOptions plain = options_with_integrator(options);
    plain.integration = false;
    Fit fit = estimate(integrate(data), plain);
    append_integrator(fit);
    return fit;
}

}  // namespace

Fit finished_fit(const IdData& data, const FitOptions& options, const Estimation& estimate) {
    return finished(data, options, integrated_inputs, estimate);
}

Fit finished_discrete_fit(const IdData& data, const FitOptions& options, const Estimation& estimate) {
    return finished(data, options, summed_inputs, estimate);
}

}  // namespace dynlab::inline numerics
