#include "numerics/estimators/sriv.h"

#include "numerics/fit/discrete_fit.h"

namespace dynlab::inline numerics {

PolynomialEstimate sriv(const IdData& data, const PolynomialOrders& orders, const PolynomialOptions& options) {
    return fit_discrete_output("sriv", data, orders, options, [&](const DiscreteOutput& model, const Vector& y) {
        return iterate_instruments(model, y, instrument_start(model, y, options.cancel), options.MaxIter, options.Tol,
                                   options.cancel);
    });
}

}  // namespace dynlab::inline numerics
