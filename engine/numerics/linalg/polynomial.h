#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Polynomials are vectors of coefficients, highest power first; the zero polynomial is one zero.

/// Without leading zeros. Throws InvalidArgument when `p` is empty.
Vector strip_leading_zeros(const VectorView& p);
/// All roots of a polynomial (its degree many; zero roots exactly), complex ones in exact conjugate pairs: up to
/// two by formula, more as eigenvalues of the balanced companion matrix. Throws InvalidArgument for the zero polynomial
/// or coefficients that are not finite.
ComplexVector roots(const VectorView& p);
/// The monic polynomial with these roots; complex roots must come in conjugate pairs.
Vector polynomial_from_roots(const ComplexVector& roots);
/// 1 and then `tail`: the monic polynomial with these further coefficients.
Vector monic(const VectorView& tail);
Vector multiply(const VectorView& a, const VectorView& b);
Vector add(const VectorView& a, const VectorView& b);
/// Whether all roots lie inside the left half plane (Routh's array); not for a root on its border.
bool is_hurwitz(const VectorView& p);
/// base^exponent, exponent >= 0.
Vector power(const VectorView& base, int exponent);
double evaluate(const VectorView& p, double x);
Complex evaluate(const VectorView& p, Complex x);

/// The companion matrix whose first row holds -p_1/p_0 ... -p_n/p_0 and whose subdiagonal is one: its
/// characteristic polynomial is p, its state s^(n-i)/p.
Matrix companion(const VectorView& p);

}  // namespace dynlab::inline numerics
