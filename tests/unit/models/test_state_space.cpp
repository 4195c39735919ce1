#include "numerics/models/state_space.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "numerics/models/transfer_function.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_state_space {

Vector from(std::initializer_list<double> values) {
    return Eigen::Map<const Vector>(values.begin(), static_cast<Index>(values.size()));
}

TEST(state_space, canonical_form_by_hand) {  // oracle: definition, (s + 5)/(s^2 + 4s + 3) + 2
    const StateSpace system = to_state_space(TransferFunction(from({2, 9, 11}), from({1, 4, 3})));
    EXPECT_EQ(system.A, (Matrix(2, 2) << -4, -3, 1, 0).finished());
    EXPECT_EQ(system.B, from({1, 0}));
    EXPECT_EQ(system.C, from({1, 5}).transpose());
    EXPECT_EQ(system.D(0, 0), 2);
}

TEST(state_space, back_to_the_transfer_function) {  // oracle: second route; relative degrees 0 to 4
    const Vector den = from({1, 5, 408, 416, 1600});
    for (const Vector& num :
         {from({3, 1, 2, 5, 4}), from({1, 2, 5, 4}), from({-7, 2, 9}), from({-6400, 1600}), from({8})}) {
        const TransferFunction G(num, den), back = to_transfer_function(to_state_space(G));
        EXPECT_TRUE(back.den().isApprox(G.den(), 1e-13));
        ASSERT_EQ(back.num().size(), G.num().size());
        EXPECT_TRUE(back.num().isApprox(G.num(), 1e-12)) << back.num().transpose();
    }
}

TEST(state_space, channels_of_a_matrix_system) {  // oracle: the definition C (sI - A)^-1 B + D at one point
    const Matrix A = (Matrix(3, 3) << -1, 2, 0, -3, -2, 1, 0.5, 0, -4).finished();
    const Matrix B = (Matrix(3, 2) << 1, 0, 0, 2, 1, 1).finished(), C = (Matrix(2, 3) << 1, 0, 1, 0, 1, 0).finished();
    const Matrix D = (Matrix(2, 2) << 0, 0, 0, 3).finished();
    const StateSpace system(A, B, C, D);
    const Complex s(0.2, 1.1);
    const Eigen::MatrixXcd at = C * (s * Eigen::Matrix3cd::Identity() - A).inverse() * B + D;
    for (Index output = 0; output < 2; ++output)
        for (Index input = 0; input < 2; ++input)
            EXPECT_NEAR(std::abs(to_transfer_function(system, output, input).at(s) - at(output, input)), 0, 1e-13);
}

TEST(state_space, an_output_that_the_input_does_not_reach_is_zero) {  // oracle: analytic
    const StateSpace system(-Matrix::Identity(2, 2), from({1, 0}), from({0, 1}).transpose(), Matrix::Zero(1, 1));
    EXPECT_TRUE(to_transfer_function(system).num().isZero(0));
}

TEST(state_space, names_the_matrix_that_does_not_fit) {
    const Matrix A = Matrix::Identity(2, 2);
    EXPECT_EQ(thrown_message([&] { StateSpace(A, Matrix::Ones(3, 1), Matrix::Ones(1, 2), Matrix::Ones(1, 1)); }),
              "state space: B must be 2 x 1, but it is 3 x 1");
    EXPECT_EQ(thrown_message([&] { StateSpace(A, Matrix::Ones(2, 1), Matrix::Ones(1, 3), Matrix::Ones(1, 1)); }),
              "state space: C must be 1 x 2, but it is 1 x 3");
    EXPECT_NE(thrown_message([&] { to_state_space(TransferFunction(from({1, 0}), from({1}))); }), "");
}

// Oracle: the system without the direct term, which is rounding.
TEST(state_space, a_direct_term_of_rounding_size_is_none) {
    const Matrix A{{0.9, 0.2}, {-0.2, 0.8}}, B{{1.0}, {0.5}}, C{{1.0, -2.0}};
    const auto with = to_transfer_function(StateSpace(A, B, C, Matrix::Constant(1, 1, 1e-16), 0.1));
    const auto without = to_transfer_function(StateSpace(A, B, C, Matrix::Zero(1, 1), 0.1));
    EXPECT_EQ(with.num(), without.num());
    EXPECT_EQ(with.den(), without.den());
}

}  // namespace test_state_space
}  // namespace dynlab
