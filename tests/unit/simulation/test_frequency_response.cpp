#include "numerics/simulation/frequency_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

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

TEST(frequency_response, phase_does_not_depend_on_the_frequencies_asked_for) {  // oracle: analytic
    const auto phase = [](const TransferFunction& G, double w) { return phase_degrees(G, Vector::Constant(1, w))[0]; };
    const auto degrees = [](double radians) { return radians * 180 / std::numbers::pi; };
    const TransferFunction lag(Vector::Ones(1), Eigen::Vector2d(1, 1));
    for (const double w : {0.1, 1.0, 10.0, 100.0})
        EXPECT_NEAR(phase(lag.with_delay(1), w), -degrees(std::atan(w) + w), 1e-9);
    EXPECT_NEAR(phase(TransferFunction(Vector::Ones(1), Vector::Unit(4, 0)), 2), -270, 1e-9);  // 1/s^3
    EXPECT_NEAR(phase(TransferFunction(Vector{{-1.0, 1.0}}, Vector{{1.0, 1.0}}), 3), -2 * degrees(std::atan(3)), 1e-9);
    EXPECT_NEAR(phase(TransferFunction(Vector{{-2.0}}, Vector{{1.0, 1.0}}), 1), 135, 1e-9);  // a negative gain
    EXPECT_NEAR(phase(TransferFunction(Vector{{1.0}}, Vector{{1.0, -1.0}}), 1), 180 + degrees(std::atan(1)), 1e-9);
    EXPECT_NEAR(phase(TransferFunction(Vector::Ones(1), Vector{{1.0, 0.0, 4.0}}), 1), 0, 1e-9);  // undamped
    EXPECT_NEAR(phase(TransferFunction(Vector::Ones(1), Vector{{1.0, 0.0, 4.0}}), 3), -180, 1e-9);
    const TransferFunction sum(Vector{{1.0, 0.0}}, Vector{{1.0, -1.0}}, 0.1);  // z/(z - 1)
    EXPECT_NEAR(phase(sum, 5), -90 + degrees(0.25), 1e-9);
    const TransferFunction shifts(Vector::Ones(1), Vector::Unit(8, 0), 0.1, 0.5);  // z^-12
    EXPECT_NEAR(phase(shifts, 25), -12 * degrees(2.5), 1e-9);
}

// Oracle: the second route, from one of very many frequencies to the next.
TEST(frequency_response, phase_is_that_of_a_fine_grid) {
    const std::vector<TransferFunction> models = {
        TransferFunction(Vector{{-4.0, 0.5}}, Vector{{1.0, 1.0, 4.0}}, 0, 8),
        TransferFunction(Vector{{1.0, -0.2, 9.0}}, Vector{{1.0, 0.1, 4.0, 0.0}}),
        TransferFunction(Vector{{1.0, 0.3, 2.0, 0.1, 0.5}}, Vector{{1.0, 2.0, 1.0, 5.0, 1.0, 0.2}}, 0, 0.7),
        TransferFunction(Vector{{1.0, -2.5, 1.7}}, Vector{{1.0, -1.5, 0.9, 0.0, 0.0}}, 0.5, 2),
        TransferFunction(Vector{{0.3, 0.9}}, Vector{{1.0, 0.2, -0.95, -0.19}}, 0.5)};
    for (const TransferFunction& G : models) {
        const double last = G.continuous() ? 40 : std::numbers::pi / G.Ts() * 0.999;
        const Vector fine = Vector::LinSpaced(100'000, 1e-3, last);
        const Vector expected = phase_degrees_unwrapped(frequency_response(G, fine)), found = phase_degrees(G, fine);
        const double turns = std::round((found[0] - expected[0]) / 360);
        EXPECT_LT((found.array() - expected.array() - 360 * turns).abs().maxCoeff(), 1e-6) << G.delay();
    }
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
