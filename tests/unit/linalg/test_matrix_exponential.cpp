#include "numerics/linalg/matrix_exponential.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "numerics/filters/sensitivity_system.h"
#include "numerics/linalg/polynomial.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_matrix_exponential {

TEST(matrix_exponential, of_a_rotation) {  // oracle: analytic, cos and sin
    Matrix A(2, 2);
    A << 0, -1.3, 1.3, 0;
    Matrix expected(2, 2);
    expected << std::cos(1.3), -std::sin(1.3), std::sin(1.3), std::cos(1.3);
    EXPECT_TRUE(matrix_exponential(A).isApprox(expected, 1e-15));
}

TEST(matrix_exponential, of_a_nilpotent_matrix) {  // oracle: analytic, the series ends
    Matrix A = Matrix::Zero(3, 3);
    A(0, 1) = 3;
    A(1, 2) = 2;
    Matrix expected = Matrix::Identity(3, 3) + A + A * A / 2;
    EXPECT_TRUE(matrix_exponential(A).isApprox(expected, 1e-15));
}

TEST(matrix_exponential, of_a_badly_scaled_companion_matrix) {  // oracle: analytic, poles -1e5 and -2e5, entry by entry
    Matrix A(2, 2);
    A << -3e5, -2e10, 1, 0;
    const double h = 1e-5, fast = std::exp(-2e5 * h), slow = std::exp(-1e5 * h);
    const Matrix F = matrix_exponential(A * h);
    EXPECT_NEAR(F(0, 0) / (2 * fast - slow), 1, 1e-13);
    EXPECT_NEAR(F(0, 1) / (2e5 * (fast - slow)), 1, 1e-14);
    EXPECT_NEAR(F(1, 0) / ((slow - fast) / 1e5), 1, 1e-14);
    EXPECT_NEAR(F(1, 1) / (2 * slow - fast), 1, 1e-14);
}

TEST(matrix_exponential, step_of_an_integrator_and_a_lag) {  // oracle: analytic integrals
    const Matrix A = Matrix::Constant(1, 1, -2.0), B = Matrix::Constant(1, 1, 3.0);
    const double h = 0.25, decay = std::exp(-2 * h);
    const StepMatrices step = exact_step(A, B, h);
    EXPECT_NEAR(step.F(0), decay, 1e-16);
    EXPECT_NEAR(step.G(0), 1.5 * (1 - decay), 1e-15);
    EXPECT_NEAR(step.H1(0), 3 * (2 * h - 1 + decay) / (4 * h), 1e-15);  // int_0^h e^(-2(h-s)) 3 s/h ds
    EXPECT_NEAR(step.H0(0) + step.H1(0), step.G(0), 1e-16);
    const StepMatrices integrator = exact_step(Matrix::Zero(1, 1), B, h);
    EXPECT_DOUBLE_EQ(integrator.H0(0), 3 * h / 2);
    EXPECT_DOUBLE_EQ(integrator.H1(0), 3 * h / 2);
}

// oracle: second route, the exponential of Van Loan's block matrix; steps short enough for the series,
// for its doubling, and too long for both
TEST(matrix_exponential, short_steps_agree_with_the_block_matrix) {
    for (const double h : {1e-6, 0.003, 0.06, 0.12, 0.2, 0.4, 0.8})
        for (const Index n : {1, 2, 3, 4, 6, 8}) {
            Matrix A = companion(power(Eigen::Vector2d(1, 3), static_cast<int>(n)));
            if (n == 4) A = cascade_matrix(Eigen::Vector3d(1, 0.8, 4), 0);
            if (n == 6) A = cascade_matrix(Eigen::Vector4d(1, 2.8, 5.6, 8), 0);
            if (n == 8) A = cascade_matrix(Vector{{1, 1.6, 8.64, 6.4, 16}}, 0);
            const Vector B = Vector::Unit(n, 0);
            Matrix block = Matrix::Zero(n + 2, n + 2);
            block.topLeftCorner(n, n) = h * A;
            block.block(0, n, n, 1) = h * B;
            block(n, n + 1) = 1;
            const Matrix expected = matrix_exponential(block);
            const StepMatrices step = exact_step(A, B, h);
            EXPECT_TRUE(step.F.isApprox(expected.topLeftCorner(n, n), 1e-14));
            EXPECT_TRUE(step.G.isApprox(expected.block(0, n, n, 1), 1e-14));
            EXPECT_TRUE(step.H1.isApprox(expected.block(0, n + 1, n, 1), 1e-14));
        }
}

TEST(matrix_exponential, refusals) {
    EXPECT_EQ(thrown_message([] { matrix_exponential(Matrix::Zero(2, 3)); }),
              "matrix exponential: the matrix must be square, but it has 2 rows and 3 columns");
    EXPECT_EQ(thrown_message([] { matrix_exponential(Matrix::Constant(1, 1, NAN)); }),
              "matrix exponential: the matrix contains a value that is not finite");
}

}  // namespace test_matrix_exponential
}  // namespace dynlab
