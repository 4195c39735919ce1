// Oracles: closed forms of first- and second-order systems, the residual of the Riccati equation, the poles asked for.
#include "numerics/control/state_feedback.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "numerics/error.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_state_feedback {

Matrix one(double value) {
    return Matrix::Constant(1, 1, value);
}

/// A double integrator and a swinging load behind one input.
struct Trolley {
    Matrix A{{0, 1, 0, 0}, {0, -15, 3, 0.2}, {0, 0, 0, 1}, {0, 40, -34, -0.3}};
    Matrix B{{0}, {1.1}, {0}, {-3}};
};

TEST(state_feedback, of_a_first_order_system_is_the_root_of_its_riccati_equation) {
    // 2 a p - b^2 p^2 / r + q = 0 with a = 1, b = 2, q = 3, r = 5
    const double p = (1 + std::sqrt(1 + 4 * 3 / 5.)) * 5 / 4;
    const StateFeedback found = linear_quadratic_regulator(one(1), one(2), one(3), one(5));
    EXPECT_NEAR(found.K(0, 0), 2 * p / 5, 1e-13);
    EXPECT_NEAR(found.poles[0].real(), -std::sqrt(1 + 4 * 3 / 5.), 1e-13);
}

TEST(state_feedback, of_a_double_integrator_is_the_textbook_one) {
    const StateFeedback found =
        linear_quadratic_regulator(Matrix{{0, 1}, {0, 0}}, Matrix{{0}, {1}}, Matrix{{1, 0}, {0, 0}}, one(1));
    EXPECT_NEAR(found.K(0, 0), 1, 1e-12);
    EXPECT_NEAR(found.K(0, 1), std::sqrt(2.), 1e-12);
}

TEST(state_feedback, minimises_the_cost_of_the_way_from_any_state) {
    // K = R^-1 B'P for the P of this K's cost, which solves A_c'P + P A_c + Q + K'R K = 0
    const Trolley system;
    const Matrix Q = Vector{{100, 1, 50, 0}}.asDiagonal(), R = one(0.1);
    const Matrix K = linear_quadratic_regulator(system.A, system.B, Q, R).K;
    const Matrix closed = system.A - system.B * K, cost = Q + K.transpose() * R * K;
    Matrix lyapunov = Matrix::Zero(16, 16);
    const Matrix I = Matrix::Identity(4, 4);
    for (Index i = 0; i < 4; ++i)
        for (Index j = 0; j < 4; ++j)
            lyapunov.block(4 * i, 4 * j, 4, 4) =
                closed(j, i) * I + (i == j ? Matrix(closed.transpose()) : Matrix(Matrix::Zero(4, 4)));
    const Vector p = lyapunov.partialPivLu().solve(-Vector(cost.reshaped()));
    const Matrix P = p.reshaped(4, 4);
    EXPECT_LT((R.inverse() * system.B.transpose() * P - K).norm(), 1e-9 * K.norm());
    EXPECT_LT((closed.transpose() * P + P * closed + cost).norm(), 1e-8 * cost.norm());
}

// x1'' = -2 x1' + u with its states in other units, x = S z: K_z = K S; K is known, for the closed loop is of second
// order.
TEST(state_feedback, units_of_the_states_do_not_matter) {
    const Matrix A{{0, 1}, {0, -2}}, B{{0}, {1}}, Q = Vector{{100, 1}}.asDiagonal();
    const double position = 10, speed = -2 + std::sqrt(4 + 1 + 2 * position);
    for (const double first : {1e-9, 1.0, 1e9})
        for (const double second : {1e-9, 1.0, 1e9}) {
            const Vector S{{first, second}}, inverse = S.cwiseInverse();
            const StateFeedback found =
                linear_quadratic_regulator(inverse.asDiagonal() * A * S.asDiagonal(), inverse.asDiagonal() * B,
                                           S.asDiagonal() * Q * S.asDiagonal(), one(1));
            EXPECT_NEAR(found.K(0, 0) / first / position, 1, 1e-12) << S.transpose();
            EXPECT_NEAR(found.K(0, 1) / second / speed, 1, 1e-12) << S.transpose();
            EXPECT_NEAR(found.poles.real().sum(), -2 - speed, 1e-10) << S.transpose();
        }
    const StateFeedback stiff = linear_quadratic_regulator(A, B, Matrix{{1e12, 0}, {0, 1}}, one(1e-6));
    EXPECT_NEAR(stiff.K(0, 0) / 1e9, 1, 1e-12);
    EXPECT_NEAR(stiff.K(0, 1) / (-2 + std::sqrt(4 + 1e6 + 2e9)), 1, 1e-12);
}

TEST(state_feedback, puts_poles_where_they_are_asked) {
    const Trolley system;
    const ComplexVector asked{{Complex(-2, 3), Complex(-2, -3), Complex(-4, 0), Complex(-9, 0)}};
    const StateFeedback found = pole_placement(system.A, system.B, asked);
    for (const Complex& pole : asked) EXPECT_LT((found.poles.array() - pole).abs().minCoeff(), 1e-9);
    const Matrix closed = system.A - system.B * found.K;
    EXPECT_NEAR(closed.trace(), -17, 1e-9);
    EXPECT_NEAR(closed.determinant(), 13 * 4 * 9, 1e-7);
}

TEST(state_feedback, places_observer_poles_by_duality) {
    const Matrix A{{0, 1}, {-26, -0.3}};
    const Matrix L =
        pole_placement(A.transpose(), Matrix{{1}, {0}}, ComplexVector{{Complex(-8, 0), Complex(-9, 0)}}).K.transpose();
    const Matrix error = A - L * Matrix{{1, 0}};
    EXPECT_NEAR(error.trace(), -17, 1e-10);
    EXPECT_NEAR(error.determinant(), 72, 1e-9);
}

TEST(state_feedback, refuses_what_no_feedback_can_do) {
    const Matrix A{{1, 0}, {0, -2}}, unreached{{0}, {1}};
    const auto regulate = [&](const Matrix& Q) { linear_quadratic_regulator(A, unreached, Q, one(1)); };
    EXPECT_NE(thrown_message([&] { regulate(Matrix::Identity(2, 2)); }).find("not controllable"), std::string::npos);
    EXPECT_NE(thrown_message([&] { regulate(Matrix{{-1, 0}, {0, 1}}); }).find("semidefinite"), std::string::npos);
    EXPECT_NE(thrown_message([&] { regulate(Matrix::Identity(3, 3)); }).find("2 x 2"), std::string::npos);
    EXPECT_NE(thrown_message([&] { linear_quadratic_regulator(one(1), one(1), one(1), one(0)); }).find("positive"),
              std::string::npos);
    EXPECT_THROW(linear_quadratic_regulator(one(0), one(1), one(0), one(1)), InvalidArgument) << "unseen integrator";
    EXPECT_NE(thrown_message([&] {
                  pole_placement(A, unreached, ComplexVector{{Complex(-1, 0), Complex(-3, 0)}});
              }).find("not controllable"),
              std::string::npos);
    EXPECT_NE(thrown_message([&] {
                  pole_placement(A, Matrix{{1}, {1}}, ComplexVector{{Complex(-1, 1), Complex(-3, 0)}});
              }).find("conjugate"),
              std::string::npos);
    EXPECT_NE(thrown_message([&] {
                  pole_placement(A, Matrix::Identity(2, 2), ComplexVector{{Complex(-1, 0), Complex(-3, 0)}});
              }).find("one input"),
              std::string::npos);
}

}  // namespace test_state_feedback
}  // namespace dynlab
