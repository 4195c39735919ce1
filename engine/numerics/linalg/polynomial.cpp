#include "numerics/linalg/polynomial.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

template <class Scalar>
Scalar horner(const VectorView& p, Scalar x) {
    Scalar value = 0;
    for (const double coefficient : p) value = value * x + coefficient;
    return value;
}

Index trailing_zeros(const VectorView& p) {
    Index count = 0;
    while (count + 1 < p.size() && p(p.size() - 1 - count) == 0) ++count;
    return count;
}

}  // namespace

Vector strip_leading_zeros(const VectorView& p) {
    if (p.size() == 0) throw InvalidArgument("a polynomial needs at least one coefficient, but none was given");
    Index first = 0;
    while (first + 1 < p.size() && p(first) == 0) ++first;
    return p.tail(p.size() - first);
}

Matrix companion(const VectorView& p) {
    const Index n = p.size() - 1;
    Matrix A = Matrix::Zero(n, n);
    if (n == 0) return A;
    A.row(0) = -p.tail(n).transpose() / p(0);
    A.diagonal(-1).setOnes();
    return A;
}

namespace {

/// Roots of x^2 + p x + q, q not zero; of two real ones the larger first.
Eigen::Vector2cd quadratic_roots(double p, double q) {
    const int exponent = std::ilogb(std::max(std::abs(p), std::sqrt(std::abs(q))));  // keeps the squares finite
    const double half = std::scalbn(-0.5 * p, -exponent), product = std::scalbn(q, -2 * exponent);
    // half^2 - product with the rounding error of the square made good (Kahan), for nearly equal roots.
    const double square = half * half, discriminant = (square - product) + std::fma(half, half, -square);
    const double root = std::scalbn(std::sqrt(std::abs(discriminant)), exponent);
    if (discriminant < 0) return {Complex(-0.5 * p, root), Complex(-0.5 * p, -root)};
    const double larger = -0.5 * p + std::copysign(root, -p);
    return {larger, q / larger};
}

}  // namespace

ComplexVector roots(const VectorView& p) {
    const Vector stripped = strip_leading_zeros(p);
    if (!stripped.allFinite()) throw InvalidArgument("roots: the polynomial contains a coefficient that is not finite");
    if (stripped(0) == 0) throw InvalidArgument("roots: every number is a root of the zero polynomial");
    const Index zero_roots = trailing_zeros(stripped);
    const Index others = stripped.size() - 1 - zero_roots;
    ComplexVector result = ComplexVector::Zero(others + zero_roots);
    if (others == 0) return result;
    if (others == 1) {
        result[0] = -stripped[1] / stripped[0];
    } else if (others == 2) {
        result.head(2) = quadratic_roots(stripped[1] / stripped[0], stripped[2] / stripped[0]);
    } else {
        Matrix A = companion(stripped.head(others + 1));
        balance(A);
        result.head(others) = eigenvalues(A);
    }
    return result;
}

Vector polynomial_from_roots(const ComplexVector& roots) {
    ComplexVector p = ComplexVector::Ones(1);
    for (const Complex& root : roots) {
        ComplexVector next = ComplexVector::Zero(p.size() + 1);
        next.head(p.size()) = p;
        next.tail(p.size()) -= root * p;
        p = std::move(next);
    }
    return p.real();
}

Vector monic(const VectorView& tail) {
    Vector p(tail.size() + 1);
    p << 1, tail;
    return p;
}

Vector multiply(const VectorView& a, const VectorView& b) {
    Vector product = Vector::Zero(a.size() + b.size() - 1);
    for (Index i = 0; i < a.size(); ++i) product.segment(i, b.size()) += a(i) * b;
    return product;
}

Vector add(const VectorView& a, const VectorView& b) {
    Vector sum = Vector::Zero(std::max(a.size(), b.size()));
    sum.tail(a.size()) = a;
    sum.tail(b.size()) += b;
    return sum;
}

Vector power(const VectorView& base, int exponent) {
    Vector result = Vector::Ones(1);
    for (int i = 0; i < exponent; ++i) result = multiply(result, base);
    return result;
}

double evaluate(const VectorView& p, double x) {
    return horner(p, x);
}
Complex evaluate(const VectorView& p, Complex x) {
    return horner(p, x);
}

bool is_hurwitz(const VectorView& p) {
    const Index n = p.size() - 1;
    const Vector scaled = p / p[0];
    Vector before = Vector::Zero(n + 2), row = Vector::Zero(n + 2);
    for (Index i = 0; i <= n; ++i) (i % 2 == 0 ? before : row)[i / 2] = scaled[i];
    for (Index k = 1; k <= n; ++k) {  // row holds the k-th row of the array
        if (!(row[0] > 0)) return false;
        Vector next = Vector::Zero(n + 2);
        for (Index i = 0; i + 1 < next.size(); ++i) next[i] = before[i + 1] - before[0] / row[0] * row[i + 1];
        before = row;
        row = next;
    }
    return true;
}

}  // namespace dynlab::inline numerics
