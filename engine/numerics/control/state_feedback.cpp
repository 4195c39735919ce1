#include "numerics/control/state_feedback.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {
namespace {

void require_size(const char* name, const MatrixView& M, Index rows, Index columns) {
    if (M.rows() != rows || M.cols() != columns)
        throw InvalidArgument("{} must be a {} x {} matrix, but is {} x {}", name, rows, columns, M.rows(), M.cols());
    if (!M.allFinite()) throw InvalidArgument("{} contains a value that is not finite", name);
}

void require_system(const MatrixView& A, const MatrixView& B) {
    if (A.rows() == 0) throw InvalidArgument("A must have at least one row");
    require_size("A", A, A.rows(), A.rows());
    require_size("B", B, A.rows(), std::max<Index>(B.cols(), 1));
}

void require_symmetric(const char* name, const MatrixView& M) {
    if (!M.isApprox(M.transpose(), 1e-10) && M.norm() > 0) throw InvalidArgument("{} must be symmetric", name);
}

StateFeedback closed(const MatrixView& A, const MatrixView& B, Matrix K) {
    StateFeedback result{std::move(K), {}};
    Matrix loop = A - B * result.K;
    balance(loop);
    result.poles = eigenvalues(loop);
    return result;
}

/// Coefficients c_0 ... c_{n-1} of the monic polynomial with these roots.
Vector monic_coefficients(const ComplexVector& roots) {
    ComplexVector c = ComplexVector::Zero(roots.size() + 1);
    c[0] = 1;
    for (Index k = 0; k < roots.size(); ++k) {
        for (Index i = k + 1; i > 0; --i) c[i] = c[i - 1] - roots[k] * c[i];
        c[0] *= -roots[k];
    }
    if (c.imag().norm() > 1e-9 * (1 + c.real().norm()))
        throw InvalidArgument("complex poles must come in conjugate pairs, such as -2 + 3i and -2 - 3i");
    return c.real().head(roots.size());
}

/// How far the poles reached are from those asked for, each pole taken once, relative to their size.
double misplacement(const ComplexVector& asked, ComplexVector reached) {
    const double size = std::max(asked.cwiseAbs().maxCoeff(), 1e-300);
    double worst = 0;
    for (Index k = 0; k < asked.size(); ++k) {
        Index nearest = k;
        for (Index i = k; i < reached.size(); ++i)
            if (std::abs(reached[i] - asked[k]) < std::abs(reached[nearest] - asked[k])) nearest = i;
        std::swap(reached[k], reached[nearest]);
        worst = std::max(worst, std::abs(reached[k] - asked[k]) / size);
    }
    return worst;
}

}  // namespace

StateFeedback linear_quadratic_regulator(const MatrixView& A, const MatrixView& B, const MatrixView& Q,
                                         const MatrixView& R) {
    require_system(A, B);
    const Index n = A.rows();
    require_size("Q", Q, n, n);
    require_size("R", R, B.cols(), B.cols());
    require_symmetric("Q", Q);
    require_symmetric("R", R);
    const auto cheapest = solve_by_cholesky(R, B.transpose());  // R^-1 B'
    if (!cheapest) throw InvalidArgument("R must be positive definite: every input needs a positive weight");
    if (symmetric_eigenvalues(Q).minCoeff() < -1e-10 * Q.norm())
        throw InvalidArgument("Q must be positive semidefinite");

    Matrix hamiltonian(2 * n, 2 * n);
    hamiltonian << A, -B * cheapest->x, -Q, -A.transpose();
    const Vector scale = balance(hamiltonian);  // states may be measured in units of all sizes
    const auto [values, vectors] = eigenvectors(hamiltonian);
    const double size = std::max(values.cwiseAbs().maxCoeff(), 1e-300);
    Eigen::MatrixXcd stable(2 * n, n);
    Index count = 0;
    for (Index i = 0; i < 2 * n; ++i)
        if (values[i].real() < -1e-10 * size && count < n) stable.col(count++) = vectors.col(i);
    const auto inverse = count < n ? std::nullopt : inverse_of_regular(stable.topRows(n));
    if (!inverse)
        throw InvalidArgument(
            "the Riccati equation has no stabilizing solution: an unstable mode is not controllable, or a mode on the "
            "imaginary axis is not observable through Q");
    const Matrix P = scale.tail(n).asDiagonal() * (stable.bottomRows(n) * *inverse).real() *
                     scale.head(n).cwiseInverse().asDiagonal();
    return closed(A, B, cheapest->x * (P + P.transpose()) / 2);
}

StateFeedback pole_placement(const MatrixView& A, const MatrixView& B, const ComplexVector& poles) {
    require_system(A, B);
    const Index n = A.rows();
    if (B.cols() != 1)
        throw InvalidArgument("pole placement needs a system with one input, but B has {} columns", B.cols());
    if (poles.size() != n)
        throw InvalidArgument("the system has {}, so the number of poles must be the same, but is {}",
                              plural(n, "{} state", "{} states"), poles.size());
    if (!poles.allFinite()) throw InvalidArgument("all poles must be finite");
    const Vector c = monic_coefficients(poles);

    constexpr double kSingular = 1e-15;  // reciprocal of a condition number that leaves no digit
    // K = [0 ... 0 1] [B AB ... A^(n-1)B]^-1 p(A), in time units that make the powers of A alike
    const double scale = std::max(A.norm(), 1e-300);
    Matrix reach(n, n);
    reach.col(0) = B;
    for (Index k = 1; k < n; ++k) reach.col(k) = A * reach.col(k - 1) / scale;
    const auto [last_row, reciprocal_condition] = solve_by_lu(reach.transpose(), Vector::Unit(n, n - 1));
    if (!(reciprocal_condition > kSingular))
        throw InvalidArgument(
            "the system is not controllable: the input does not affect every mode, so the poles cannot be placed "
            "arbitrarily");
    Eigen::RowVectorXd row = last_row.transpose() / std::pow(scale, n - 1);
    Eigen::RowVectorXd K = Eigen::RowVectorXd::Zero(n);
    for (Index k = 0; k < n; ++k, row = row * A) K += c[k] * row;
    K += row;

    StateFeedback result = closed(A, B, K);
    if (misplacement(poles, result.poles) > 1e-4)
        throw InvalidArgument(
            "rounding errors prevent the pole placement: the scales of the states differ too much, or the input has "
            "almost no effect on one state. Use other units for the states, or move the poles less");
    return result;
}

}  // namespace dynlab::inline numerics
