#include "numerics/fit/frequency_start.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "numerics/criteria/frequency_output.h"
#include "numerics/simulation/frequency_response.h"

namespace test_frequency_start {

using namespace dynlab;

const Vector kFrequencies = Vector::LinSpaced(120, std::log(0.01), std::log(100)).array().exp();

TEST(frequency_start, without_noise_is_the_system_over_four_decades) {  // oracle: the system
    const TransferFunction G(Vector{{2.0, 5.0, 1.0}}, Vector{{1.0, 12.0, 30.0, 40.0, 9.0}}, 0, 0.2);
    const FrequencyData data = frequency_data(frequency_response(G, kFrequencies), kFrequencies, Vector());
    const FrequencyStart start = sanathanan_koerner(equation_lines(data, 0.2), 4, 2, 5);
    // the unit of time is one second: the geometric mean of the frequencies is 1
    EXPECT_NEAR(frequency_time_unit(data), 1, 1e-12);
    const Vector truth{{12.0, 30.0, 40.0, 9.0, 2.0, 5.0, 1.0}};
    EXPECT_LT((start.coefficients - truth).norm(), 1e-9 * truth.norm());
    EXPECT_LT(start.squares, 1e-20);
}

TEST(frequency_start, equation_is_that_of_plain_least_squares) {  // second route: powers of s, normal equations
    const Vector w{{0.5, 0.8, 1.1, 1.7, 2.4}};
    const ComplexVector H{
        {Complex(1.1, -0.2), Complex(1.3, -0.6), Complex(0.7, -1.4), Complex(-0.3, -0.5), Complex(-0.2, -0.1)}};
    const EquationLines lines = equation_lines(frequency_data(H, w, Vector{{0.1, 0.2, 0.3, 0.2, 0.1}}), 0);
    const Vector sizes{{1.0, 1.2, 2.0, 3.0, 4.0}};
    const Vector found = equation_solution(lines, sizes, 2, 0);
    Matrix A(10, 3);
    Vector b(10);
    for (Index k = 0; k < 5; ++k) {
        const double weight = lines.weights[k] / sizes[k];
        const Complex s = lines.s[k], rows[] = {-s * H[k], -H[k], 1.0};
        for (Index i = 0; i < 3; ++i) A(k, i) = weight * rows[i].real(), A(k + 5, i) = weight * rows[i].imag();
        const Complex right = s * s * H[k];
        b[k] = weight * right.real(), b[k + 5] = weight * right.imag();
    }
    const Vector direct = (A.transpose() * A).inverse() * (A.transpose() * b);
    EXPECT_LT((found - direct).norm(), 1e-10 * direct.norm());
}

TEST(frequency_start, lines_know_the_hold) {  // oracle: the hold's response (1 - exp(-i w Ts))/(i w Ts)
    const Vector w{{0.5, 1.0}};
    const FrequencyData data = frequency_data(ComplexVector::Ones(2), w, Vector(), 0.4, InterSample::kZoh);
    const EquationLines lines = equation_lines(data, 0);
    for (Index k = 0; k < 2; ++k) {
        const Complex angle(0, w[k] * 0.4);
        EXPECT_LT(std::abs(lines.response[k] - angle / (1.0 - std::exp(-angle))), 1e-14);
    }
}

TEST(frequency_start, poles_are_mirrored_and_zeros_stay) {  // oracle: (s - 1)(s + 2) by hand
    EXPECT_LT((with_stable_poles(Vector{{1.0, -2.0, 7.0}}, 2) - Vector{{3.0, 2.0, 7.0}}).norm(), 1e-14);
}

}  // namespace test_frequency_start
