#include "numerics/estimators/oe.h"

#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/finished_fit.h"

namespace dynlab::inline numerics {

Fit oe(const IdData& data, const PolynomialOrders& orders, const FitOptions& options) {
    return finished_discrete_fit(data, options, [&](const IdData& seen, const FitOptions& wanted) {
        return fit_discrete_output("oe", seen, orders, wanted, output_error_search(wanted));
    });
}

}  // namespace dynlab::inline numerics
