#include "numerics/linalg/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace dynlab::inline numerics {

namespace {

constexpr double kSingular = 1e-15;  // reciprocal of a condition number that leaves no digit

Matrix triangle_of(const Eigen::HouseholderQR<Matrix>& qr) {
    return qr.matrixQR().topRows(std::min(qr.rows(), qr.cols())).triangularView<Eigen::Upper>();
}

}  // namespace

namespace {

/// Turns two columns by an angle.
void rotate(double c, double s, double* x, double* y, Index size) {
    for (Index i = 0; i < size; ++i) {
        const double turned = c * x[i] - s * y[i];
        y[i] = s * x[i] + c * y[i];
        x[i] = turned;
    }
}

double dot(const double* x, const double* y, Index size) {
    return Eigen::Map<const Vector>(x, size).dot(Eigen::Map<const Vector>(y, size));
}

/// Makes the columns of the square X orthogonal by rotations, pair by pair, and applies these to `turned` as well.
void make_orthogonal(Matrix& X, Matrix& turned) {
    constexpr int kMostSweeps = 60;
    const Index n = X.cols();
    const double rounding = std::sqrt(static_cast<double>(n)) * std::numeric_limits<double>::epsilon();
    bool changed = true;
    for (int sweep = 0; changed && sweep < kMostSweeps; ++sweep) {
        changed = false;
        for (Index i = 0; i < n; ++i)
            for (Index j = i + 1; j < n; ++j) {
                double *const x = X.col(i).data(), *const y = X.col(j).data();
                const double xx = dot(x, x, n), yy = dot(y, y, n), xy = dot(x, y, n);
                if (!(std::abs(xy) > rounding * std::sqrt(xx) * std::sqrt(yy))) continue;
                const double cotangent = (yy - xx) / (2 * xy);
                const double t = std::copysign(1 / (std::abs(cotangent) + std::hypot(1, cotangent)), cotangent);
                const double c = 1 / std::hypot(1, t);
                rotate(c, c * t, x, y, n);
                rotate(c, c * t, turned.col(i).data(), turned.col(j).data(), n);
                changed = true;
            }
    }
}

}  // namespace

/// One-sided, of the transposed triangle of a pivoted QR decomposition: A P = Q R, R' J = V S, so A = Q J S (P V)'.
SingularValues jacobi_svd(const MatrixView& A) {
    if (A.rows() < A.cols()) {
        SingularValues transposed = jacobi_svd(A.transpose());
        transposed.U.swap(transposed.V);
        return transposed;
    }
    const Index n = A.cols();
    const double largest = A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0;
    const double unit = largest > 0 ? std::exp2(std::ilogb(largest)) : 1;  // squares neither overflow nor vanish
    const Eigen::ColPivHouseholderQR<Matrix> qr(A / unit);
    Matrix X = Matrix::Zero(n, n), J = Matrix::Identity(n, n);
    for (Index j = 0; j < n; ++j) X.row(j).tail(n - j) = qr.matrixQR().row(j).tail(n - j);
    X.transposeInPlace();
    make_orthogonal(X, J);
    const Vector lengths = X.colwise().stableNorm().transpose();
    std::vector<Index> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return lengths[i] > lengths[j]; });
    SingularValues parts{Matrix(n, n), Vector(n), Matrix(n, n)};
    Matrix V(n, n);
    Index rank = 0;
    for (Index k = 0; k < n; ++k) {
        const Index from = order[static_cast<std::size_t>(k)];
        parts.s[k] = unit * lengths[from];
        parts.U.col(k) = J.col(from);
        if (lengths[from] > 0) V.col(rank++) = X.col(from) / lengths[from];
    }
    if (rank < n) V.rightCols(n - rank) = full_orthogonal_basis(V.leftCols(rank)).rightCols(n - rank);
    parts.U = qr.householderQ() * (Matrix(A.rows(), n) << parts.U, Matrix::Zero(A.rows() - n, n)).finished();
    for (Index i = 0; i < n; ++i) parts.V.row(qr.colsPermutation().indices()[i]) = V.row(i);
    return parts;
}

Vector singular_values(const MatrixView& A) {
    return jacobi_svd(A).s;
}

SymmetricEigen symmetric_eigen(const MatrixView& A) {
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(A);
    return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Vector symmetric_eigenvalues(const MatrixView& A) {
    return Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

TridiagonalForm tridiagonal_form(const MatrixView& A, const VectorView& b) {
    if (A.rows() == 1) return {A.diagonal(), Vector(), b};
    const Eigen::Tridiagonalization<Matrix> form(A);
    return {form.diagonal(), form.subDiagonal(), form.matrixQ().adjoint() * b};
}

Eigenvectors eigenvectors(const MatrixView& A) {
    const Eigen::EigenSolver<Matrix> eigen(A);
    return {eigen.eigenvalues(), eigen.eigenvectors()};
}

ComplexVector eigenvalues(const MatrixView& A) {
    return Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
}

Matrix triangular_part(const MatrixView& A) {
    return triangle_of(Eigen::HouseholderQR<Matrix>(A));
}

RotatedEquations rotate_equations(const MatrixView& A, const VectorView& b) {
    const Eigen::HouseholderQR<Matrix> qr(A);
    const Vector rotated = qr.householderQ().adjoint() * b;
    return {triangle_of(qr), rotated.head(std::min(A.rows(), A.cols()))};
}

Matrix full_orthogonal_basis(const MatrixView& A) {
    return Eigen::HouseholderQR<Matrix>(A).householderQ();
}

Matrix solve_by_pivoted_qr(const MatrixView& A, const MatrixView& B) {
    return Eigen::ColPivHouseholderQR<Matrix>(A).solve(B);
}

Matrix shortest_solution(const MatrixView& A, const MatrixView& B) {
    const SingularValues parts = jacobi_svd(A);
    const double size = static_cast<double>(std::max(A.rows(), A.cols())), s0 = parts.s.size() > 0 ? parts.s[0] : 0;
    const Index rank = (parts.s.array() > size * std::numeric_limits<double>::epsilon() * s0).count();
    return parts.V.leftCols(rank) *
           (parts.s.head(rank).cwiseInverse().asDiagonal() * (parts.U.leftCols(rank).transpose() * B));
}

std::optional<Matrix> cholesky_root(const MatrixView& A) {
    const Eigen::LLT<Matrix> factor(A);
    if (factor.info() != Eigen::Success) return {};
    return Matrix(factor.matrixL());
}

std::optional<SquareSolution> solve_by_cholesky(const MatrixView& A, const MatrixView& B) {
    const Eigen::LLT<Matrix> factor(A);
    if (factor.info() != Eigen::Success) return {};
    return SquareSolution{factor.solve(B), factor.rcond()};
}

Vector solve_semidefinite(const MatrixView& A, const VectorView& b) {
    return Eigen::LDLT<Matrix>(A).solve(b);
}

SquareSolution solve_by_lu(const MatrixView& A, const MatrixView& B) {
    const Eigen::PartialPivLU<Matrix> factor(A);
    return {factor.solve(B), factor.rcond()};
}

std::optional<Eigen::MatrixXcd> inverse_of_regular(const Eigen::MatrixXcd& A) {
    // [Re -Im; Im Re] multiplies real and imaginary parts as A does.
    const Index n = A.rows();
    Matrix real(2 * n, 2 * n);
    real.topLeftCorner(n, n) = real.bottomRightCorner(n, n) = A.real();
    real.bottomLeftCorner(n, n) = A.imag();
    real.topRightCorner(n, n) = -A.imag();
    const auto [x, reciprocal_condition] = solve_by_lu(real, Matrix::Identity(2 * n, n));
    if (!(reciprocal_condition > kSingular)) return {};
    Eigen::MatrixXcd inverse(n, n);
    inverse.real() = x.topRows(n);
    inverse.imag() = x.bottomRows(n);
    return inverse;
}

namespace {

/// The power of two that brings a column norm nearest to its row norm.
double balancing_factor(double column_norm, double row_norm) {
    const double exponent = std::round(0.5 * std::log2(row_norm / column_norm));
    return std::exp2(exponent);
}

}  // namespace

Vector balance(Eigen::Ref<Matrix> A) {
    constexpr double kWorthwhile = 0.95;  // a smaller reduction of the norms is not worth another sweep
    const Index n = A.rows();
    Vector scale = Vector::Ones(n);
    const Vector diagonal = A.diagonal();  // stays as it is, and would hide small neighbours in the sums
    A.diagonal().setZero();
    for (bool changed = true; changed;) {
        changed = false;
        for (Index i = 0; i < n; ++i) {
            const double column_norm = A.col(i).lpNorm<1>(), row_norm = A.row(i).lpNorm<1>();
            if (!(column_norm > 0) || !(row_norm > 0)) continue;
            if (row_norm < 2 * column_norm && column_norm < 2 * row_norm) continue;  // the factor would be one
            const double factor = balancing_factor(column_norm, row_norm);
            if (column_norm * factor + row_norm / factor >= kWorthwhile * (column_norm + row_norm)) continue;
            A.col(i) *= factor;
            A.row(i) /= factor;
            scale(i) *= factor;
            changed = true;
        }
    }
    A.diagonal() = diagonal;
    return scale;
}

}  // namespace dynlab::inline numerics
