#include "numerics/fit/discrete/polynomial_fit.h"

#include <algorithm>

#include "base/number_text.h"
#include "numerics/error.h"

namespace dynlab::inline numerics {

void check_polynomial_data(const std::string& method, const IdData& data, const PolynomialOrders& orders) {
    if (data.output_count() != 1)
        throw InvalidArgument(method + " needs one output, and the data hold " + std::to_string(data.output_count()) +
                              ": select one");
    if (data.input_count() > 0 && static_cast<std::size_t>(data.input_count()) != orders.inputs())
        throw InvalidArgument(method + ": the data have " + counted(data.input_count(), "input") +
                              ", so each of nb, nf and nk needs as many values, and " +
                              std::to_string(orders.inputs()) + " were given");
    check_sampled_data(method, data);
    const int longest_delay = *std::max_element(orders.nk.begin(), orders.nk.end());
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
        if (longest_delay >= data.sample_count(e))
            throw InvalidArgument(method + ": the delay nk = " + counted(longest_delay, "sample") +
                                  " is not shorter than the record of " + counted(data.sample_count(e), "sample"));
}

Fit polynomial_fit(const PolynomialOrders& orders, const VectorView& theta, double Ts) {
    Fit fit;
    fit.orders = std::make_shared<PolynomialOrders>(orders);
    fit.polynomial = std::make_shared<PolynomialModel>(orders, theta, Ts);
    fit.names = orders.parameter_names();
    fit.theta = theta;
    return fit;
}

void make_polynomial(Fit& fit, const PolynomialOrders& orders, double Ts) {
    const Index d = orders.parameter_count();
    Fit own = polynomial_fit(orders, fit.theta.head(d), Ts);
    fit.orders = std::move(own.orders);
    fit.polynomial = std::move(own.polynomial);
    fit.names = std::move(own.names);
    fit.theta = std::move(own.theta);
    fit.covariance = fit.covariance.topLeftCorner(d, d).eval();
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
}

void warn_of_unstable_polynomials(Fit& fit) {
    for (std::size_t input = 0; input < fit.orders->inputs(); ++input)
        if (!fit.polynomial->transfer_function(input).stable()) {
            fit.warnings.push_back(
                "The model is unstable (a pole lies outside or on the unit circle), so its simulation grows without "
                "bound: unless the system is unstable, too, take fewer poles, or sriv, which keeps them inside the "
                "circle.");
            return;
        }
}

}  // namespace dynlab::inline numerics
