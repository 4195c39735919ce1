#include "numerics/linalg/orthogonal_polynomials.h"

#include "numerics/error.h"

namespace dynlab::inline numerics {

OrthogonalPolynomials orthogonal_polynomials(const ComplexVector& s, const VectorView& weights, Index degree) {
    constexpr double kDependent = 1e-12;  // of what is left of s p_j
    if (weights.size() != s.size())
        throw InvalidArgument(
            "orthogonal polynomials need one weight for each point, but the number of points is {} and the number of "
            "weights is {}",
            s.size(), weights.size());
    OrthogonalPolynomials basis{Eigen::MatrixXcd(s.size(), degree + 1), Matrix::Zero(degree + 1, degree + 1)};
    const Vector squares = weights.cwiseAbs2();
    const auto product = [&](const ComplexVector& a, const ComplexVector& b) {
        return squares.dot((a.conjugate().cwiseProduct(b)).real());
    };
    ComplexVector next = ComplexVector::Ones(s.size());
    Vector powers = Vector::Unit(degree + 1, degree);
    double size = std::sqrt(product(next, next));
    for (Index j = 0; j <= degree; ++j) {
        if (j > 0) {
            next = s.cwiseProduct(basis.values.col(j - 1));
            powers << basis.coefficients.col(j - 1).tail(degree), 0;
            size = std::sqrt(product(next, next));
            for (int pass = 0; pass < 2; ++pass)
                for (Index i = 0; i < j; ++i) {
                    const double part = product(basis.values.col(i), next);
                    next -= part * basis.values.col(i);
                    powers -= part * basis.coefficients.col(i);
                }
        }
        const double length = std::sqrt(product(next, next));
        if (!(length > kDependent * size)) {
            if (j == 0) throw InvalidArgument("the response is zero at all frequencies, so no model can be estimated");
            throw InvalidArgument(
                "{} frequencies cannot distinguish a polynomial of degree {} from polynomials of lower degree: use "
                "fewer poles and zeros, or a wider band",
                s.size(), j);
        }
        basis.values.col(j) = next / length;
        basis.coefficients.col(j) = powers / length;
    }
    return basis;
}

}  // namespace dynlab::inline numerics
