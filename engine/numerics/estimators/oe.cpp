#include "numerics/estimators/oe.h"

#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/finished_fit.h"

namespace dynlab::inline numerics {

Fit oe(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    return finished_discrete_fit(data, options, [&](const IdData& seen, const FitOptions& requested) {
        return fit_discrete_output("oe", seen, orders, requested, output_error_search(requested));
    });
}

}  // namespace dynlab::inline numerics
