#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>

#include "numerics/criteria/denominator_group.h"
#include "numerics/filters/transfer_sensitivity.h"
#include "numerics/linalg/polynomial.h"
#include "support/transfer_cases.h"

namespace test_denominator_group {

using namespace dynlab;
using namespace dynlab::test;

TEST(denominator_group, solved_equations_and_inverse) {  // oracle: a general solver, wildly scaled rows and columns
    Matrix A(3, 3);
    A << 4, 1, 0.5, 1, 3, -1, 0.2, -0.7, 5;
    const Vector scale{{1e-6, 1.0, 1e5}}, truth{{1e6, -2.0, 3e-5}};
    NormalEquations equations;
    equations.z_phi = scale.asDiagonal() * A * scale.asDiagonal();
    equations.z_y = equations.z_phi * truth;
    double condition = 0;
    EXPECT_LT(relative_difference(solve_equations(equations, &condition), truth), 1e-12);
    EXPECT_LT(condition, 100);
    equations.z_phi.col(1) = equations.z_phi.col(0);
    equations.z_phi.row(1) = equations.z_phi.row(0);
    EXPECT_FALSE(solve_equations(equations).allFinite());
    const Matrix gram = scale.asDiagonal() * (A.transpose() * A) * scale.asDiagonal();
    EXPECT_LT((inverse_gram(gram) * gram - Matrix::Identity(3, 3)).cwiseAbs().maxCoeff(), 1e-4);
    const Matrix scaled = scale.asDiagonal() * inverse_gram(gram) * scale.asDiagonal();
    EXPECT_LT((scaled * (A.transpose() * A) - Matrix::Identity(3, 3)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(denominator_group, unstable_roots_are_mirrored) {  // oracle: the roots written down
    // (s - 1)(s + 2)(s^2 - 2s + 5) -> (s + 1)(s + 2)(s^2 + 2s + 5)
    const Vector unstable = multiply(multiply(values({1, -1}), values({1, 2})), values({1, -2, 5}));
    const Vector mirrored = multiply(multiply(values({1, 1}), values({1, 2})), values({1, 2, 5}));
    bool any = false;
    EXPECT_LT((reflect_unstable_roots(unstable, &any) - mirrored).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_TRUE(any);
    EXPECT_EQ(reflect_unstable_roots(mirrored, &any), mirrored);
    EXPECT_FALSE(any);
    EXPECT_LT((filter_denominator(2, 3) - values({1, 6, 12, 8})).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(denominator_group, gram_of_the_instruments) {  // oracle: second route, the sensitivities stored
    const IdData data = course_system_data(0.1, 1);
    const DenominatorGroup group(data, TransferStructure::single(2, 0), 0, Hold::kFoh);
    const Vector theta{{4.0, 3.0, 2.0}};
    const Matrix all =
        transfer_sensitivities(values({2}), values({1, 4, 3}), 0, data.experiments[0].u.col(0), 0.01, Hold::kZoh);
    const Matrix Psi = all.middleCols(1, 3), expected = Psi.transpose() * Psi;
    EXPECT_LT((group.refined(theta, true).z_z - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff());
    EXPECT_EQ(group.sample_count(), data.sample_count());
    EXPECT_EQ(group.parameter_count(), 3);
}

}  // namespace test_denominator_group
