#include "numerics/validation/chi_squared.h"

#include <cmath>
#include <limits>
#include <string>

#include "numerics/error.h"

namespace dynlab {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kMostTerms = 100000;

// x^a exp(-x)/Gamma(a)
double front(double a, double x) {
    return std::exp(a * std::log(x) - x - std::lgamma(a));
}

// P(a, x), for x < a + 1.
double lower_by_series(double a, double x) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < kMostTerms && term > kEpsilon * sum; ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * front(a, x);
}

// Q(a, x), for x >= a + 1 (modified Lentz).
double upper_by_fraction(double a, double x) {
    constexpr double kTiny = 1e-300;
    double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, fraction = d;
    for (int n = 1; n < kMostTerms; ++n) {
        const double numerator = -n * (n - a);
        b += 2;
        d = numerator * d + b;
        if (std::abs(d) < kTiny) d = kTiny;
        c = b + numerator / c;
        if (std::abs(c) < kTiny) c = kTiny;
        d = 1 / d;
        fraction *= c * d;
        if (std::abs(c * d - 1) < kEpsilon) break;
    }
    return fraction * front(a, x);
}

}  // namespace

double chi_squared_upper_tail(double x, double degrees) {
    if (!(degrees > 0) || !std::isfinite(degrees) || std::isnan(x))
        throw InvalidArgument("The chi-squared distribution needs a number and positive degrees of freedom, and got " +
                              std::to_string(x) + " and " + std::to_string(degrees));
    if (x <= 0) return 1;
    if (std::isinf(x)) return 0;
    const double a = 0.5 * degrees, half = 0.5 * x;
    return half < a + 1 ? 1 - lower_by_series(a, half) : upper_by_fraction(a, half);
}

double chi_squared_quantile(double probability, double degrees) {
    if (!(probability > 0 && probability < 1))
        throw InvalidArgument("A probability between 0 and 1 is wanted, and got " + std::to_string(probability));
    const double tail = 1 - probability;
    double low = 0, high = degrees + 1;
    while (chi_squared_upper_tail(high, degrees) > tail) {
        low = high;
        high *= 2;
    }
    while (high - low > 4 * kEpsilon * high) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (chi_squared_upper_tail(middle, degrees) > tail ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double normal_half_width(double probability) {
    return std::sqrt(chi_squared_quantile(probability, 1));
}

}  // namespace dynlab
