#include "numerics/statistics/chi_squared.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using ChiSquared = boost::math::chi_squared_distribution<double, Policy>;

void check_arguments(double x, double degrees) {
    if (!(degrees > 0) || !std::isfinite(degrees) || std::isnan(x))
        throw InvalidArgument("The chi-squared distribution needs a number and positive degrees of freedom, and got " +
                              std::to_string(x) + " and " + std::to_string(degrees));
}

void check_probability(double probability) {
    if (!(probability > 0 && probability < 1))
        throw InvalidArgument("A probability must lie between 0 and 1, but it is " + std::to_string(probability));
}

}  // namespace

double chi_squared_upper_tail(double x, double degrees) {
    check_arguments(x, degrees);
    if (x <= 0) return 1;
    if (std::isinf(x)) return 0;
    return cdf(complement(ChiSquared(degrees), x));
}

double chi_squared_quantile(double probability, double degrees) {
    check_probability(probability);
    check_arguments(probability, degrees);
    return quantile(ChiSquared(degrees), probability);
}

double normal_half_width(double probability) {
    check_probability(probability);
    return std::numbers::sqrt2 * boost::math::erf_inv(probability, Policy());
}

}  // namespace dynlab::inline numerics
