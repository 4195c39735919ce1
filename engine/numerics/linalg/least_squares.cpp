#include "numerics/linalg/least_squares.h"

#include <limits>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

void check_sizes(const MatrixView& A, const VectorView& b) {
    if (A.rows() != b.size())
        throw InvalidArgument("least squares: the matrix has {}, but the right-hand side has {}",
                              plural(A.rows(), "{} row", "{} rows"), plural(b.size(), "{} value", "{} values"));
    if (A.cols() == 0) throw InvalidArgument("least squares: the matrix has no columns");
    if (A.rows() < A.cols())
        throw InvalidArgument("least squares: {} cannot determine {}; more data are needed",
                              plural(A.rows(), "{} equation", "{} equations"),
                              plural(A.cols(), "{} parameter", "{} parameters"));
    if (!A.allFinite()) throw InvalidArgument("least squares: the matrix contains a value that is not finite");
    if (!b.allFinite()) throw InvalidArgument("least squares: the right-hand side contains a value that is not finite");
}

Vector column_scale(const MatrixView& A) {
    Vector scale = A.colwise().stableNorm().transpose();
    for (double& value : scale)
        if (value == 0) value = 1;
    return scale;
}

}  // namespace

LeastSquares solve_least_squares(const MatrixView& A, const VectorView& b) {
    check_sizes(A, b);
    const Index columns = A.cols();
    const Vector unscale = column_scale(A).cwiseInverse();
    const auto [R, rotated] = rotate_equations(A * unscale.asDiagonal(), b);
    const auto [left, singular, right] = jacobi_svd(R);
    const double smallest_kept = static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon() * singular(0);
    const Index rank = (singular.array() > smallest_kept).count();
    const Matrix V = (unscale.asDiagonal() * right.leftCols(rank)) * singular.head(rank).cwiseInverse().asDiagonal();

    LeastSquares result;
    result.solution = V * (left.leftCols(rank).transpose() * rotated);
    result.residuals = b - A * result.solution;
    result.inverse_gram = V * V.transpose();
    result.rank = rank;
    result.condition_number =
        rank == columns ? singular(0) / singular(columns - 1) : std::numeric_limits<double>::infinity();
    return result;
}

}  // namespace dynlab::inline numerics
