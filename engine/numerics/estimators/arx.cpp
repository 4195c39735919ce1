#include "numerics/estimators/arx.h"

#include "numerics/fit/equation_error.h"

namespace dynlab::inline numerics {

Fit arx(const IdData& data, const PolynomialOrders& orders) {
    check_equation_error("arx", data, orders);
    const ArxSolution solution = solve_rich_arx("arx", data, orders);
    Fit estimate = polynomial_fit(orders, solution.theta, data.Ts);
    report_equation_error(estimate, data);
    estimate.covariance = estimate.noise_variance[0] * solution.inverse_gram;
    estimate.condition_number = solution.condition_number;
    describe_equation_error(estimate);
    warn_of_operating_point(estimate, data);
    estimate.message = Message(
        "Least squares with {} equations: fit {} % for one-step prediction, {} % for simulation from measured past "
        "values.",
        ArxEquations(data, orders).count(), significant(estimate.prediction_fit_percent, 4),
        significant(estimate.fit_percent[0], 4));
    return estimate;
}

}  // namespace dynlab::inline numerics
