#include "numerics/linalg/orthogonal_polynomials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/linalg/polynomial.h"
#include "support/thrown_message.h"

namespace test_orthogonal_polynomials {

using namespace dynlab;
using testing::HasSubstr;

ComplexVector axis_points(double low, double high, Index count) {
    const Vector w = Vector::LinSpaced(count, std::log(low), std::log(high)).array().exp();
    return Complex(0, 1) * w.cast<Complex>();
}

TEST(orthogonal_polynomials, are_orthonormal_over_four_decades) {  // oracle: the definition
    const ComplexVector s = axis_points(0.01, 100, 200);
    const Vector weights = Vector::LinSpaced(200, 0.5, 3);
    const OrthogonalPolynomials basis = orthogonal_polynomials(s, weights, 8);
    const Eigen::MatrixXcd weighted = weights.cast<Complex>().asDiagonal() * basis.values;
    const Matrix gram = (weighted.adjoint() * weighted).real();
    EXPECT_LT((gram - Matrix::Identity(9, 9)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(orthogonal_polynomials, have_the_coefficients_of_their_values) {  // oracle: Horner's rule
    const ComplexVector s = axis_points(0.1, 10, 60);
    const OrthogonalPolynomials basis = orthogonal_polynomials(s, Vector::Ones(60), 5);
    for (Index j = 0; j <= 5; ++j) {
        EXPECT_EQ(basis.coefficients.col(j).head(5 - j), Vector::Zero(5 - j)) << "degree " << j;
        for (Index k = 0; k < s.size(); ++k)
            EXPECT_LT(std::abs(evaluate(Vector(basis.coefficients.col(j)), s[k]) - basis.values(k, j)),
                      1e-9 * basis.values.col(j).cwiseAbs().maxCoeff());
    }
}

TEST(orthogonal_polynomials, of_two_points_are_as_by_hand) {
    // s = i, 2i, weights one: p_0 = 1/sqrt 2, and s p_0 has Re(conj(p_0) s p_0) = 0, so that p_1 = s/sqrt 5.
    const OrthogonalPolynomials basis =
        orthogonal_polynomials(ComplexVector{{Complex(0, 1), Complex(0, 2)}}, Vector::Ones(2), 1);
    EXPECT_NEAR(basis.coefficients(1, 0), 1 / std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(basis.coefficients(0, 1), 1 / std::sqrt(5.0), 1e-15);
    EXPECT_NEAR(basis.coefficients(1, 1), 0, 1e-15);
}

TEST(orthogonal_polynomials, need_enough_points) {
    const ComplexVector s = axis_points(1, 2, 2);
    EXPECT_THAT(
        thrown_message([&] { orthogonal_polynomials(s, Vector::Ones(2), 4); }),
        HasSubstr("2 frequencies cannot distinguish a polynomial of degree 4 from polynomials of lower degree"));
    EXPECT_THAT(thrown_message([&] { orthogonal_polynomials(s, Vector::Ones(3), 1); }), HasSubstr("one weight"));
}

}  // namespace test_orthogonal_polynomials
