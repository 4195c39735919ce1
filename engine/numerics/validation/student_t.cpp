#include "numerics/validation/student_t.h"

#include <cmath>
#include <limits>
#include <string>

#include "numerics/error.h"

namespace dynlab {

namespace {

void require_degrees(double degrees) {
    if (!(degrees > 0) || !std::isfinite(degrees))
        throw InvalidArgument("Student's t needs a positive number of degrees of freedom, and got " +
                              std::to_string(degrees) + ": use more samples than parameters");
}

// The continued fraction behind I_x(a, b); converges quickly for x < (a + 1)/(a + b + 2).
double beta_fraction(double a, double b, double x) {
    constexpr double kTiny = 1e-300;
    const auto away_from_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
    double c = 1, d = 1 / away_from_zero(1 - (a + b) * x / (a + 1));
    double fraction = d;
    for (int m = 1; m < 100000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / away_from_zero(1 + even * d);
        c = away_from_zero(1 + even / c);
        fraction *= c * d;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / away_from_zero(1 + odd * d);
        c = away_from_zero(1 + odd / c);
        fraction *= c * d;
        if (std::abs(c * d - 1) < std::numeric_limits<double>::epsilon()) break;
    }
    return fraction;
}

// I_x(a, b) with 1 - x given beside x, so that x close to one loses no digits.
double incomplete_beta_both(double a, double b, double x, double one_minus_x) {
    if (x <= 0) return 0;
    if (one_minus_x <= 0) return 1;
    const double log_x = x < 0.5 ? std::log(x) : std::log1p(-one_minus_x);
    const double log_rest = x < 0.5 ? std::log1p(-x) : std::log(one_minus_x);
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * log_x + b * log_rest);
    if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(a, b, x) / a;
    return 1 - front * beta_fraction(b, a, one_minus_x) / b;
}

// P(t > x) for x >= 0.
double upper_tail(double x, double degrees) {
    const double square = x * x, total = degrees + square;
    return 0.5 * incomplete_beta_both(0.5 * degrees, 0.5, degrees / total, square / total);
}

double density(double x, double degrees) {
    return std::exp(std::lgamma(0.5 * (degrees + 1)) - std::lgamma(0.5 * degrees) -
                    0.5 * std::log(degrees * std::acos(-1.0)) - 0.5 * (degrees + 1) * std::log1p(x * x / degrees));
}

// The x >= 0 whose upper tail is `tail` <= 1/2: Newton on ln P(t > x), inside a bracket that only shrinks.
double upper_tail_inverse(double tail, double degrees) {
    double low = 0, high = 1;
    while (upper_tail(high, degrees) > tail) {
        low = high;
        high *= 2;
    }
    double x = 0.5 * (low + high);
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double value = upper_tail(x, degrees);
        (value > tail ? low : high) = x;
        double next = x + std::log(value / tail) * value / density(x, degrees);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        const bool settled = std::abs(next - x) <= 2e-16 * x;
        x = next;
        if (settled) break;
    }
    return x;
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
    if (!(a > 0) || !(b > 0) || !(x >= 0 && x <= 1))
        throw InvalidArgument("The incomplete beta function needs a > 0, b > 0 and x between 0 and 1, and got a = " +
                              std::to_string(a) + ", b = " + std::to_string(b) + ", x = " + std::to_string(x));
    return incomplete_beta_both(a, b, x, 1 - x);
}

double student_t_cdf(double x, double degrees) {
    require_degrees(degrees);
    return x >= 0 ? 1 - upper_tail(x, degrees) : upper_tail(-x, degrees);
}

double student_t_quantile(double probability, double degrees) {
    require_degrees(degrees);
    if (!(probability > 0 && probability < 1))
        throw InvalidArgument("A probability between 0 and 1 is wanted, and got " + std::to_string(probability));
    if (probability == 0.5) return 0;
    if (probability < 0.5) return -upper_tail_inverse(probability, degrees);
    return upper_tail_inverse(1 - probability, degrees);
}

}  // namespace dynlab
