#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/statistics/chi_squared.h"

namespace test_chi_squared {

using namespace dynlab;

TEST(chi_squared, tail_of_even_degrees_is_a_poisson_sum) {  // oracle: analytic
    for (const int half : {1, 2, 5, 13, 40})
        for (const double x : {0.3, 2.0, 9.0, 26.0, 60.0, 150.0}) {
            double sum = 0;
            for (int i = 0; i < half; ++i) sum += std::exp(i * std::log(x / 2) - x / 2 - std::lgamma(i + 1.0));
            EXPECT_NEAR(chi_squared_upper_tail(x, 2 * half) / sum, 1, 1e-11) << half << ' ' << x;
        }
}

TEST(chi_squared, tail_of_one_degree_is_the_error_function) {  // oracle: analytic
    for (const double x : {1e-4, 0.1, 1.0, 3.0, 10.0, 100.0})
        EXPECT_NEAR(chi_squared_upper_tail(x, 1) / std::erfc(std::sqrt(x / 2)), 1, 1e-11) << x;
}

TEST(chi_squared, quantile_inverts_the_tail) {  // oracle: residual of the definition
    for (const double degrees : {1.0, 2.0, 7.5, 25.0, 200.0})
        for (const double p : {0.01, 0.5, 0.95, 0.999})
            EXPECT_NEAR(chi_squared_upper_tail(chi_squared_quantile(p, degrees), degrees), 1 - p, 1e-12);
    EXPECT_NEAR(chi_squared_quantile(0.95, 2), -2 * std::log(0.05), 1e-12);
}

TEST(chi_squared, half_width_of_the_normal_distribution) {  // oracle: the error function
    for (const double p : {0.5, 0.9, 0.99, 0.9999})
        EXPECT_NEAR(std::erf(normal_half_width(p) / std::sqrt(2)), p, 1e-13);
}

TEST(chi_squared, refuses_what_has_no_meaning) {
    EXPECT_THROW(chi_squared_upper_tail(1, 0), InvalidArgument);
    EXPECT_THROW(chi_squared_upper_tail(std::nan(""), 3), InvalidArgument);
    EXPECT_THROW(chi_squared_quantile(1, 3), InvalidArgument);
    EXPECT_THROW(chi_squared_quantile(0.5, -1), InvalidArgument);
    EXPECT_THROW(normal_half_width(0), InvalidArgument);
    EXPECT_THROW(normal_half_width(1), InvalidArgument);
    EXPECT_EQ(chi_squared_upper_tail(-1, 3), 1);
    EXPECT_EQ(chi_squared_upper_tail(std::numeric_limits<double>::infinity(), 3), 0);
}

}  // namespace test_chi_squared
