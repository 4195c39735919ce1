#include "numerics/criteria/rational_basis.h"

#include <gtest/gtest.h>

#include "numerics/linalg/polynomial.h"

namespace test_rational_basis {

using namespace dynlab;

TEST(rational_basis, has_the_quotients_of_its_coefficients) {  // oracle: Horner's rule, there and back
    const Vector w = Vector::LinSpaced(80, std::log(0.05), std::log(20)).array().exp();
    const ComplexVector s = Complex(0, 1) * w.cast<Complex>();
    const RationalBasis basis = rational_basis(s, w.cwiseInverse(), Vector::Ones(80), 4, 2);
    const Vector coefficients{{3.0, 8.0, 4.0, 1.5, 0.3, -2.0, 5.0}};
    const Vector q = basis.parameters(coefficients);
    EXPECT_LT((basis.coefficients(q) - coefficients).norm(), 1e-10 * coefficients.norm());
    const ComplexVector quotient = basis.numerator(q).cwiseQuotient(basis.denominator(q));
    for (Index k = 0; k < s.size(); ++k) {
        const Complex truth =
            evaluate(Vector(coefficients.tail(3)), s[k]) / evaluate(monic(coefficients.head(4)), s[k]);
        EXPECT_LT(std::abs(quotient[k] - truth), 1e-10 * std::abs(truth));
    }
}

}  // namespace test_rational_basis
