#include "numerics/fit/discrete/polynomial_fit.h"

#include <algorithm>

#include "numerics/error.h"

namespace dynlab::inline numerics {

void check_polynomial_channels(const std::string& method, const IdData& data, const PolynomialOrders& orders) {
    if (data.output_count() != 1)
        throw InvalidArgument("{} needs one output, but the data have {}: select one", method, data.output_count());
    if (data.input_count() > 0 && static_cast<std::size_t>(data.input_count()) != orders.inputs())
        throw InvalidArgument(
            "{}: the data have {}, so nb, nf and nk need one value for each input, but the number of values is {}",
            method, plural(data.input_count(), "{} input", "{} inputs"), orders.inputs());
    const int longest_delay = *std::max_element(orders.nk.begin(), orders.nk.end());
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
        if (longest_delay >= data.sample_count(e))
            throw InvalidArgument(
                "{}: the delay nk = {} is not shorter than the data, which have {}. Decrease nk, or use more data",
                method, plural(longest_delay, "{} sample", "{} samples"),
                plural(data.sample_count(e), "{} sample", "{} samples"));
}

void check_polynomial_data(const std::string& method, const IdData& data, const PolynomialOrders& orders) {
    check_polynomial_channels(method, data, orders);
    check_sampled_data(method, data);
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
                Message("The model is unstable (a pole is outside or on the unit circle), so its simulation grows "
                        "without bound. Unless the system is also unstable, use fewer poles, or sriv, which keeps the "
                        "poles inside the circle."));
            return;
        }
}

}  // namespace dynlab::inline numerics
