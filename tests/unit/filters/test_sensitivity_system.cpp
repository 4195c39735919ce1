#include "numerics/filters/sensitivity_system.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <complex>

#include "numerics/linalg/polynomial.h"

namespace test_sensitivity_system {

using namespace dynlab;

Eigen::VectorXcd response(const SingleInputSystem& system, Complex s) {
    const Eigen::MatrixXcd resolvent = s * Eigen::MatrixXcd::Identity(system.A.rows(), system.A.rows()) - system.A;
    return system.C.cast<Complex>() * resolvent.inverse() * system.B.cast<Complex>() + system.D.cast<Complex>();
}

// oracle: analytic, the formulas of the header as functions of s
TEST(sensitivity_system, outputs_are_the_derivatives_of_the_transfer_function) {
    const Vector A{{1, 1.2, 3, 0.7}};
    for (const Vector& B : {Vector{{2.0}}, Vector{{-1.5, 2}}, Vector{{0.4, -1.5, 2}}, Vector{{0.3, 0.4, -1.5, 2}}}) {
        const Index n = 3, m = B.size() - 1;
        const SingleInputSystem system = sensitivity_system(B, A);
        ASSERT_EQ(system.C.rows(), n + m + 3);
        for (const Complex s : {Complex(0.3, 0), Complex(0, 1.7), Complex(2, -3)}) {
            const Eigen::VectorXcd y = response(system, s);
            const Complex a = evaluate(A, s), b = evaluate(B, s);
            EXPECT_LT(std::abs(y[0] - b / a), 1e-13);
            for (Index i = 1; i <= n; ++i) EXPECT_LT(std::abs(y[i] + std::pow(s, n - i) * b / (a * a)), 1e-13);
            for (Index j = 0; j <= m; ++j) EXPECT_LT(std::abs(y[n + 1 + j] - std::pow(s, m - j) / a), 1e-13);
            // With as many zeros as poles the impulses of the feed-through are left out.
            const Complex feed = m == n ? B[0] : 0;
            EXPECT_LT(std::abs(y[n + m + 2] + s * (b / a - feed)), 1e-12);
        }
    }
}

// oracle: analytic, A(p) z = u and A(p) w = p^r z
TEST(sensitivity_system, the_cascade_drives_the_second_system_by_a_derivative_of_the_first) {
    const Vector A{{1, 1.2, 3, 0.7}};
    for (Index r = 0; r < 3; ++r) {
        const SingleInputSystem w{cascade_matrix(A, r), Vector::Unit(6, 0), Matrix::Identity(6, 6), Vector::Zero(6)};
        const Complex s(0.2, 1.1), a = evaluate(A, s);
        const Eigen::VectorXcd x = response(w, s);
        for (Index i = 0; i < 3; ++i) {
            EXPECT_LT(std::abs(x[i] - std::pow(s, 2 - i) / a), 1e-14);
            EXPECT_LT(std::abs(x[3 + i] - std::pow(s, 2 - i + r) / (a * a)), 1e-14);
        }
    }
}

}  // namespace test_sensitivity_system
