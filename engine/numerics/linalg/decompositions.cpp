#include "numerics/linalg/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dynlab::inline numerics {

namespace {

constexpr double kSingular = 1e-15;  // reciprocal of a condition number that leaves no digit

Matrix triangle_of(const Eigen::HouseholderQR<Matrix>& qr) {
    return qr.matrixQR().topRows(std::min(qr.rows(), qr.cols())).triangularView<Eigen::Upper>();
}

}  // namespace

SingularValues jacobi_svd(const MatrixView& A) {
    const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Vector singular_values(const MatrixView& A) {
    return Eigen::JacobiSVD<Matrix>(A).singularValues();
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

Matrix minimum_norm_solution(const MatrixView& A, const MatrixView& B) {
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
    const Vector diagonal = A.diagonal();  // stays as it is, and would hide small neighbors in the sums
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
