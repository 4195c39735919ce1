#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/statistics/distributions.h"
#include "support/thrown_message.h"

namespace test_distributions {

using namespace dynlab;

TEST(distributions, chi_squared_tail_of_even_degrees_is_a_poisson_sum) {  // oracle: analytic
    for (const int half : {1, 2, 5, 13, 40})
        for (const double x : {0.3, 2.0, 9.0, 26.0, 60.0, 150.0}) {
            double sum = 0;
            for (int i = 0; i < half; ++i) sum += std::exp(i * std::log(x / 2) - x / 2 - std::lgamma(i + 1.0));
            EXPECT_NEAR(chi_squared_upper_tail(x, 2 * half) / sum, 1, 1e-11) << half << ' ' << x;
        }
}

TEST(distributions, chi_squared_tail_of_one_degree_is_the_error_function) {  // oracle: analytic
    for (const double x : {1e-4, 0.1, 1.0, 3.0, 10.0, 100.0})
        EXPECT_NEAR(chi_squared_upper_tail(x, 1) / std::erfc(std::sqrt(x / 2)), 1, 1e-11) << x;
}

TEST(distributions, chi_squared_quantile_inverts_the_tail) {  // oracle: residual of the definition
    for (const double degrees : {1.0, 2.0, 7.5, 25.0, 200.0})
        for (const double p : {0.01, 0.5, 0.95, 0.999})
            EXPECT_NEAR(chi_squared_upper_tail(chi_squared_quantile(p, degrees), degrees), 1 - p, 1e-12);
    EXPECT_NEAR(chi_squared_quantile(0.95, 2), -2 * std::log(0.05), 1e-12);
}

TEST(distributions, half_width_of_the_normal_distribution) {  // oracle: the error function
    for (const double p : {0.5, 0.9, 0.99, 0.9999})
        EXPECT_NEAR(std::erf(normal_half_width(p) / std::sqrt(2)), p, 1e-13);
}

TEST(distributions, chi_squared_refuses_what_has_no_meaning) {
    EXPECT_THROW(chi_squared_upper_tail(1, 0), InvalidArgument);
    EXPECT_THROW(chi_squared_upper_tail(std::nan(""), 3), InvalidArgument);
    EXPECT_THROW(chi_squared_quantile(1, 3), InvalidArgument);
    EXPECT_THROW(chi_squared_quantile(0.5, -1), InvalidArgument);
    EXPECT_THROW(normal_half_width(0), InvalidArgument);
    EXPECT_THROW(normal_half_width(1), InvalidArgument);
    EXPECT_EQ(thrown_message([] { normal_half_width(1.5); }),
              "the probability must be between 0 and 1, but 1.5 was given");
    EXPECT_EQ(thrown_message([] { chi_squared_upper_tail(2, 0); }),
              "The chi-squared distribution needs a numeric value and positive degrees of freedom, but got 2 with 0 "
              "degrees of freedom");
    EXPECT_EQ(chi_squared_upper_tail(-1, 3), 1);
    EXPECT_EQ(chi_squared_upper_tail(std::numeric_limits<double>::infinity(), 3), 0);
}

const double kPi = std::acos(-1.0);

// Composite Simpson rule of Student's density from 0 to x: a second route to the distribution.
double integrated_density(double x, double degrees) {
    const int intervals = 20000;
    const double h = x / intervals;
    const double scale = std::tgamma(0.5 * (degrees + 1)) / (std::sqrt(degrees * kPi) * std::tgamma(0.5 * degrees));
    double sum = 0;
    for (int i = 0; i <= intervals; ++i) {
        const double t = i * h, weight = (i == 0 || i == intervals) ? 1 : (i % 2 ? 4 : 2);
        sum += weight * std::pow(1 + t * t / degrees, -0.5 * (degrees + 1));
    }
    return scale * sum * h / 3;
}

TEST(distributions, student_t_one_degree_is_cauchy) {  // oracle: analytic
    for (double p : {0.001, 0.2, 0.6, 0.95, 0.975, 0.9999})
        EXPECT_NEAR(student_t_quantile(p, 1) / std::tan(kPi * (p - 0.5)), 1, 1e-11) << p;
}

TEST(distributions, student_t_two_and_four_degrees_closed_form) {  // oracle: analytic (Shaw 2006)
    for (double p : {1e-8, 0.01, 0.55, 0.9, 0.975, 0.999}) {
        const double alpha = 4 * p * (1 - p);
        EXPECT_NEAR(student_t_quantile(p, 2) / ((2 * p - 1) * std::sqrt(2 / alpha)), 1, 1e-12) << p;
        const double q = std::cos(std::acos(std::sqrt(alpha)) / 3) / std::sqrt(alpha);
        EXPECT_NEAR(student_t_quantile(p, 4) / std::copysign(2 * std::sqrt(q - 1), p - 0.5), 1, 1e-11) << p;
    }
}

// Even degrees: P(|t| <= x) = sin a (1 + 1/2 cos^2 a + 1 3/(2 4) cos^4 a + ... cos^(degrees - 2) a), tan a =
// x/sqrt(degrees)
double within(double x, int degrees) {
    const double angle = std::atan(x / std::sqrt(degrees));
    double sum = 0, term = 1;
    for (int power = 0; power <= degrees - 2; power += 2) {
        sum += term;
        term *= (power + 1.0) / (power + 2.0) * std::pow(std::cos(angle), 2);
    }
    return std::sin(angle) * sum;
}

TEST(distributions,
     student_t_keeps_its_digits_near_one_half) {  // oracle: finite series (Abramowitz and Stegun 26.7.3 and 26.7.4)
    for (double distance : {1e-15, 1e-9, 1e-6, 1e-3, 0.05, 0.0999999, 0.1000001, 0.3}) {
        const double p = 0.5 + distance, part = p - 0.5;
        EXPECT_NEAR(student_t_quantile(p, 1) / std::tan(kPi * part), 1, 1e-13) << p;
        for (int degrees : {2, 4, 6, 10})
            EXPECT_NEAR(within(student_t_quantile(p, degrees), degrees) / (2 * part), 1, 1e-13) << degrees << " " << p;
        for (double degrees : {1.0, 4.0, 2.5})
            EXPECT_NEAR(student_t_quantile(0.5 - part, degrees) / student_t_quantile(p, degrees), -1, 1e-12) << p;
    }
    EXPECT_EQ(student_t_quantile(0.5, 4), 0);
}

TEST(distributions, student_t_quantile_inverts_the_integral_of_the_density) {  // oracle: second route, Simpson's rule
    for (double degrees : {0.7, 1.0, 2.5, 3.0, 27.0, 100.0})
        for (double p : {0.01, 0.3, 0.5, 0.8, 0.975})
            EXPECT_NEAR(0.5 + integrated_density(student_t_quantile(p, degrees), degrees), p, 1e-11)
                << degrees << " " << p;
}

TEST(distributions, student_t_many_degrees_are_normal) {  // oracle: Cornish-Fisher expansion about the normal law
    const double nu = 1e6;
    for (double p : {0.6, 0.95, 0.975}) {
        double z = 1;
        for (int i = 0; i < 60; ++i)
            z -= (0.5 * std::erfc(-z / std::sqrt(2.0)) - p) * std::sqrt(2 * kPi) * std::exp(0.5 * z * z);
        EXPECT_NEAR(student_t_quantile(p, nu), z + (z * z * z + z) / (4 * nu), 1e-8) << p;
    }
}

TEST(distributions, student_t_refuses_what_has_no_answer) {
    EXPECT_THROW(student_t_quantile(0, 5), InvalidArgument);
    EXPECT_THROW(student_t_quantile(1, 5), InvalidArgument);
    EXPECT_THROW(student_t_quantile(0.3, 0.001), InvalidArgument);  // beyond the range of Boost
    EXPECT_THROW(student_t_quantile(0.9, 0), InvalidArgument);
    EXPECT_THROW(student_t_quantile(0.9, std::nan("")), InvalidArgument);
    EXPECT_THROW(student_t_quantile(std::nan(""), 5), InvalidArgument);
}

}  // namespace test_distributions
