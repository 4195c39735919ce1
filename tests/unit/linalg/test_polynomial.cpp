#include "numerics/linalg/polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_polynomial {

ComplexVector sorted(ComplexVector values) {
    std::sort(values.begin(), values.end(),
              [](Complex a, Complex b) { return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag(); });
    return values;
}

Vector from(std::initializer_list<double> values) {
    return Eigen::Map<const Vector>(values.begin(), static_cast<Index>(values.size()));
}

TEST(polynomial, roots_of_known_products) {  // oracle: analytic
    EXPECT_TRUE(sorted(roots(from({1, 4, 3}))).isApprox(Eigen::Vector2cd(-3, -1), 1e-15));
    const ComplexVector pair = sorted(roots(from({2, 4, 10})));
    EXPECT_NEAR(std::abs(pair(0) - Complex(-1, -2)), 0, 1e-14);
    EXPECT_EQ(pair(0), std::conj(pair(1)));
}

TEST(polynomial, hurwitz_as_the_roots_say) {  // oracle: second route, all roots
    RandomStream random(3);
    int stable = 0;
    for (int run = 0; run < 400; ++run) {
        Vector p = random.normal(2 + run % 6);
        if (run % 2 == 0) p = p.cwiseAbs();
        const bool left = roots(p).real().maxCoeff() < 0;
        EXPECT_EQ(is_hurwitz(p), left) << p.transpose();
        stable += left ? 1 : 0;
    }
    EXPECT_GT(stable, 80);
    EXPECT_FALSE(is_hurwitz(from({1, 0, 4})));  // on the border
    EXPECT_FALSE(is_hurwitz(from({1, 2, 0})));
    EXPECT_TRUE(is_hurwitz(from({-2, -3, -1})));
}

TEST(polynomial, roots_at_zero_are_exact) {  // oracle: analytic, s^2 (s + 5)
    const ComplexVector found = sorted(roots(from({0, 1, 5, 0, 0})));
    ASSERT_EQ(found.size(), 3);
    EXPECT_NEAR(found(0).real(), -5, 1e-14);
    EXPECT_EQ(found(1), Complex(0));
    EXPECT_EQ(found(2), Complex(0));
}

TEST(polynomial, roots_of_widely_spread_magnitudes) {  // oracle: analytic; needs the balancing
    const ComplexVector found = sorted(roots(polynomial_from_roots(Eigen::Vector3cd(-1e-4, -1, -1e6))));
    EXPECT_NEAR(found(0).real() / -1e6, 1, 1e-13);
    EXPECT_NEAR(found(1).real() / -1, 1, 1e-12);
    EXPECT_NEAR(found(2).real() / -1e-4, 1, 1e-12);
}

TEST(polynomial, roots_of_quadratics) {  // oracle: analytic
    const double apart = 0x1p-23;
    const ComplexVector near = roots(Eigen::Vector3d(1, 2, 1 - apart * apart));
    EXPECT_EQ(near[0], -1 - apart);
    EXPECT_EQ(near[1], -1 + apart);
    const ComplexVector far = roots(Eigen::Vector3d(2e-100, 2e100, 2e90));
    EXPECT_NEAR(far[1].real() / -1e-10, 1, 1e-15);
    const ComplexVector swing = roots(Eigen::Vector3d(1, 1e-3, 1e300));
    EXPECT_NEAR(swing[0].imag() / 1e150, 1, 1e-15);
    EXPECT_EQ(swing[1], std::conj(swing[0]));
}

TEST(polynomial, coefficients_survive_the_way_through_the_roots) {  // oracle: second route
    const Vector p = from({1, 5, 408, 416, 1600});
    EXPECT_TRUE(polynomial_from_roots(roots(p)).isApprox(p, 1e-14));
}

TEST(polynomial, products_and_values) {  // oracle: analytic, (x + 1)^3 and x^2 - 1
    EXPECT_EQ(power(from({1, 1}), 3), from({1, 3, 3, 1}));
    EXPECT_EQ(power(from({1, 1}), 0), from({1}));
    EXPECT_EQ(multiply(from({1, 1}), from({1, -1})), from({1, 0, -1}));
    EXPECT_EQ(add(from({1, 0, 0}), from({2})), from({1, 0, 2}));
    EXPECT_EQ(evaluate(from({1, 0, -1}), 3.0), 8);
    EXPECT_EQ(evaluate(from({1, 0, -1}), Complex(0, 2)), Complex(-5, 0));
    EXPECT_EQ(strip_leading_zeros(from({0, 0, 0})), from({0}));
}

TEST(polynomial, refuses_what_has_no_roots) {
    EXPECT_EQ(thrown_message([] { roots(from({0, 0})); }), "roots: every number is a root of the zero polynomial");
    EXPECT_EQ(thrown_message([] { roots(Vector()); }),
              "a polynomial needs at least one coefficient, but none was given");
    EXPECT_EQ(thrown_message([] {
                  roots(from({1, NAN}));
              }),
              "roots: the polynomial contains a coefficient that is not finite");
}

TEST(polynomial, monic_puts_a_one_first) {  // oracle: definition
    EXPECT_EQ(monic(from({2, 3})), from({1, 2, 3}));
    EXPECT_EQ(monic(Vector()), from({1}));
}

}  // namespace test_polynomial
}  // namespace dynlab
