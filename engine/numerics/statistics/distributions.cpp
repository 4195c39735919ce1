#include "numerics/statistics/distributions.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using StudentT = boost::math::students_t_distribution<double, Policy>;
using ChiSquared = boost::math::chi_squared_distribution<double, Policy>;

void check_arguments(double x, double degrees) {
    if (!(degrees > 0) || !std::isfinite(degrees) || std::isnan(x))
        throw InvalidArgument(
            "The chi-squared distribution needs a numeric value and positive degrees of freedom, but got {} with {} "
            "degrees of freedom",
            x, degrees);
}

void check_probability(double probability) {
    if (!(probability > 0 && probability < 1))
        throw InvalidArgument("the probability must be between 0 and 1, but {} was given", probability);
}

constexpr double kNearCenter = 0.1;

// The x > 0 with P(0 < t <= x) = part, for a small part. Boost's own quantile loses digits there, at even degrees of
// freedom all of them. Newton from below, where the density is as high as at zero: monotone, the distribution being
// concave for x > 0.
double quantile_above_center(double part, double degrees) {
    const StudentT distribution(degrees);
    double x = part / pdf(distribution, 0.0);
    for (int step = 0; step < 20; ++step) {
        const double square = x * x;
        const double reached = boost::math::ibeta(0.5, degrees / 2, square / (degrees + square), Policy()) / 2;
        const double change = (part - reached) / pdf(distribution, x);
        x += change;
        if (!(std::abs(change) > 1e-16 * x)) break;
    }
    return x;
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

double student_t_quantile(double probability, double degrees) {
    if (!(degrees > 0) || !std::isfinite(degrees))
        throw InvalidArgument(
            "Student's t needs a positive number of degrees of freedom, but got {}: use more samples than parameters",
            degrees);
    check_probability(probability);
    try {
        const double off_center = probability - 0.5;  // exact, for a probability near one half
        if (off_center == 0) return 0;
        if (std::abs(off_center) < kNearCenter)
            return std::copysign(quantile_above_center(std::abs(off_center), degrees), off_center);
        return quantile(StudentT(degrees), probability);
    } catch (const std::exception&) {  // beyond what a number can hold, or the series that Boost has
        throw InvalidArgument(
            "The quantile of Student's t for the probability {} and {} degrees of freedom cannot be computed",
            probability, degrees);
    }
}

}  // namespace dynlab::inline numerics
