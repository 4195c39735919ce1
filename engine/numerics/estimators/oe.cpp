#include "numerics/estimators/oe.h"

#include "numerics/kernels/discrete_fit.h"

namespace dynlab {

PolynomialEstimate oe(const IdData& data, const PolynomialOrders& orders, const PolynomialOptions& options) {
    return fit_discrete_output("oe", data, orders, options, output_error_search(options));
}

}  // namespace dynlab
