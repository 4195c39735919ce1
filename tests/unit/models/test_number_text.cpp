#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "base/number_text.h"

namespace test_number_text {

using namespace dynlab;

TEST(number_text, agrees_with_printf) {  // oracle: the format %g of the C library
    for (const double value : {0.05, -12345.678, 1e6, 1e5, 123456.0, 1e-5, 0.0001, -2.5e-300, 1.7976931348623157e308})
        for (const int digits : {1, 3, 5, 14, 17}) {
            char expected[64];
            std::snprintf(expected, sizeof expected, "%.*g", digits, value);
            EXPECT_EQ(number_text(value, digits), expected);
        }
    EXPECT_EQ(number_text(2.0 / 3), "0.66667");
}

TEST(number_text, what_is_no_number_has_a_name) {  // oracle: the table in the header
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(number_text(kInfinity), "Inf");
    EXPECT_EQ(number_text(-kInfinity, 3), "-Inf");
    EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "NaN");
    EXPECT_EQ(number_text(-0.0), "0");
}

}  // namespace test_number_text
