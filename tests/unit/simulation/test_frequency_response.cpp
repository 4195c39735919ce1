#include "numerics/simulation/frequency_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dynlab {
namespace test_frequency_response {

TEST(frequency_response, of_a_lag_at_its_corner) {  // oracle: analytic, 1/(1 + j), -3.01 dB and -45 degrees
    const TransferFunction lag(Vector::Ones(1), Eigen::Vector2d(2, 1));
    const ComplexVector response = frequency_response(lag, Vector::Constant(1, 0.5));
    EXPECT_NEAR(std::abs(response(0) - 1.0 / Complex(1, 1)), 0, 1e-16);
    EXPECT_NEAR(magnitude_db(response)(0), -10 * std::log10(2.0), 1e-14);
    EXPECT_NEAR(phase_degrees_unwrapped(response)(0), -45, 1e-13);
}

TEST(frequency_response, phase_of_a_delay_is_not_folded) {  // oracle: analytic, -w Td
    const Vector w = Vector::LinSpaced(200, 0.1, 30);
    const Vector phase = phase_degrees_unwrapped(frequency_response(TransferFunction().with_delay(1.5), w));
    EXPECT_TRUE(phase.isApprox(-1.5 * 180 / std::numbers::pi * w, 1e-12));
}

TEST(frequency_response, discrete_delay_turns_on_the_unit_circle) {  // oracle: analytic, z^-2 at w
    const TransferFunction shift(Vector::Ones(1), Vector::Ones(1), 0.1, 0.2);
    const Complex value = frequency_response(shift, Vector::Constant(1, 3.0))(0);
    EXPECT_NEAR(std::abs(value - std::polar(1.0, -0.6)), 0, 1e-15);
}

TEST(frequency_response, natural_grid_spans_the_corners) {                            // oracle: definition
    const TransferFunction G(Eigen::Vector2d(1, 100), Eigen::Vector3d(1, 1.1, 0.1));  // corners 0.1, 1, 100
    const Vector w = natural_frequency_grid(G, 101);
    EXPECT_EQ(w.size(), 101);
    EXPECT_NEAR(std::log10(w(0)), -2.5, 1e-12);
    EXPECT_NEAR(std::log10(w(100)), 3.5, 1e-12);
    const TransferFunction discrete(Vector::Ones(1), Eigen::Vector2d(1, -0.9), 0.01);
    EXPECT_DOUBLE_EQ(natural_frequency_grid(discrete)(399), std::numbers::pi / 0.01);
}

}  // namespace test_frequency_response
}  // namespace dynlab
