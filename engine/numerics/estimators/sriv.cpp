#include "numerics/estimators/sriv.h"

#include "numerics/fit/discrete/discrete_fit.h"

namespace dynlab::inline numerics {

Fit sriv(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    return fit_discrete_output("sriv", data, orders, options, [&](const DiscreteOutput& model, const Vector& y) {
        return iterate_instruments(model, y, instrument_start(model, y, options.cancel), options.max_iterations,
                                   options.tolerance, options.cancel);
    });
}

}  // namespace dynlab::inline numerics
