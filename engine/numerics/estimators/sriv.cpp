#include "numerics/estimators/sriv.h"

#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/finished_fit.h"

namespace dynlab::inline numerics {

Fit sriv(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    return finished_discrete_fit(data, options, [&](const IdData& seen, const FitOptions& requested) {
        return fit_discrete_output("sriv", seen, orders, requested, [&](const DiscreteOutput& model, const Vector& y) {
            return iterate_instruments(model, y, instrument_start(model, y, requested.cancel), requested.max_iterations,
                                       requested.tolerance, requested.cancel);
        });
    });
}

}  // namespace dynlab::inline numerics
