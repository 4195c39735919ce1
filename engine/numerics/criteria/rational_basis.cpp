#include "numerics/criteria/rational_basis.h"

#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/orthogonal_polynomials.h"

namespace dynlab::inline numerics {

ComplexVector RationalBasis::denominator(const VectorView& q) const {
    const Index n = P.cols() - 1;
    return P.col(n) + P.leftCols(n) * q.head(n).cast<Complex>();
}

ComplexVector RationalBasis::numerator(const VectorView& q) const {
    return Q * q.tail(Q.cols()).cast<Complex>();
}

Vector RationalBasis::coefficients(const VectorView& q) const {
    return offset + map * q;
}

Vector RationalBasis::parameters(const VectorView& coefficients) const {
    return solve_by_pivoted_qr(map, coefficients - offset);
}

RationalBasis rational_basis(const ComplexVector& s, const VectorView& denominator_weights,
                             const VectorView& numerator_weights, Index poles, Index zeros) {
    const OrthogonalPolynomials P = orthogonal_polynomials(s, denominator_weights, poles);
    const OrthogonalPolynomials Q = orthogonal_polynomials(s, numerator_weights, zeros);
    const double lead = P.coefficients(0, poles);
    const Index count = poles + zeros + 1;
    RationalBasis basis{P.values, Q.values, Vector::Zero(count), Matrix::Zero(count, count)};
    basis.offset.head(poles) = P.coefficients.col(poles).tail(poles) / lead;
    basis.map.topLeftCorner(poles, poles) = P.coefficients.bottomLeftCorner(poles, poles) / lead;
    basis.map.bottomRightCorner(zeros + 1, zeros + 1) = Q.coefficients / lead;
    return basis;
}

}  // namespace dynlab::inline numerics
