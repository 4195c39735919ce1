#include "numerics/fit/doubts.h"

#include "numerics/fit/assessment.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/integrated_input.h"
#include "numerics/fit/missed_options.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

namespace {

using Estimation = std::function<Fit(const IdData&, const FitOptions&)>;
using Doubting = std::function<void(Fit&, const IdData&, const FitOptions&)>;

Fit finished(const IdData& data, const FitOptions& options, IdData (*integrate)(const IdData&),
             const Estimation& estimate, const Doubting& doubt) {
    const IdData integrated = options.integration ? integrate(data) : IdData();
    const IdData& seen = options.integration ? integrated : data;
    const FitOptions wanted = options.integration ? options_with_integrator(options) : options;
    FitOptions plain = wanted;
    plain.integration = plain.doubts = false;
    Fit fit = estimate(seen, plain);
    if (options.doubts) doubt(fit, seen, wanted);
    if (options.integration) append_integrator(fit);
    return fit;
}

}  // namespace

void add_missed_option(Fit& fit, const std::optional<MissedOption>& missed) {
    if (!missed) return;
    fit.doubts.missed_option = missed;
    fit.warnings.push_back(sentence_of(*missed));
}

void add_assessment(Fit& fit, const IdData& data, const FitOptions& options) {
    if (!options.doubts) return;
    if (auto assessment = assess_if_affordable(data, fit))
        fit.doubts.assessment = std::make_shared<const Assessment>(std::move(*assessment));
}

Fit finished_fit(const IdData& data, const FitOptions& options, const Estimation& estimate) {
    return finished(data, options, integrated_inputs, estimate,
                    [](Fit& fit, const IdData& seen, const FitOptions& wanted) {
                        const bool with_noise = fit.noise.has_value();
                        if (!wanted.start_is_given && !(with_noise && wanted.integration))
                            add_missed_option(fit, missed_option(seen, fit, wanted));
                        if (!with_noise) add_assessment(fit, seen, wanted);
                    });
}

Fit finished_discrete_fit(const IdData& data, const FitOptions& options, const Estimation& estimate) {
    return finished(data, options, summed_inputs, estimate,
                    [&](Fit& fit, const IdData& seen, const FitOptions& wanted) {
                        const auto again = [&](const FitOptions& other) { return estimate(seen, other); };
                        if (fit.orders->na + fit.orders->nc + fit.orders->nd == 0 && !wanted.start_is_given)
                            add_missed_option(fit, missed_discrete_option(seen, fit, wanted, again));
                        add_assessment(fit, seen, wanted);
                    });
}

}  // namespace dynlab::inline numerics
