#include "numerics/estimators/oe.h"

#include "numerics/fit/discrete/discrete_fit.h"

namespace dynlab::inline numerics {

Fit oe(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    return fit_discrete_output("oe", data, orders, options, output_error_search(options));
}

}  // namespace dynlab::inline numerics
