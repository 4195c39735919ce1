#pragma once
#include <optional>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

// Eigen's decompositions of matrices whose size is known at run time only. Their templates take a compiler half a
// minute each, so they are compiled here and nowhere else. Arguments are finite, and square where that is said.

/// A = U diag(s) V', with min(rows, columns) columns in U and V and s falling.
struct SingularValues {
    Matrix U;
    Vector s;
    Matrix V;
};
/// By Jacobi rotations behind a pivoted QR decomposition: small singular values to full relative accuracy.
SingularValues jacobi_svd(const MatrixView& A);
Vector singular_values(const MatrixView& A);  ///< falling

/// Of a symmetric matrix, of which the lower triangle is read: rising eigenvalues, orthonormal eigenvectors as columns.
struct SymmetricEigen {
    Vector values;
    Matrix vectors;
};
SymmetricEigen symmetric_eigen(const MatrixView& A);
Vector symmetric_eigenvalues(const MatrixView& A);

/// A = Q T Q' for a symmetric A, T tridiagonal: its diagonal, its off-diagonal, and Q'b. Takes a quarter of the work of
/// the eigenvalues.
struct TridiagonalForm {
    Vector diagonal, beside, rotated;
};
TridiagonalForm tridiagonal_form(const MatrixView& A, const VectorView& b);

/// Replaces the square matrix A by D^-1 A D and returns the diagonal of D: powers of two, chosen so that the norms
/// of each row and column of A nearly agree. No rounding error is made; eigenvalues and functions of badly scaled
/// matrices (companion matrices above all) become accurate. (Parlett and Reinsch 1969.)
Vector balance(Eigen::Ref<Matrix> A);

/// Of a square matrix, in no order; conjugate pairs are adjacent.
struct Eigenvectors {
    ComplexVector values;
    Eigen::MatrixXcd vectors;
};
Eigenvectors eigenvectors(const MatrixView& A);
ComplexVector eigenvalues(const MatrixView& A);

/// R of A = Q R by Householder reflections: min(rows, columns) rows, upper triangular.
Matrix triangular_part(const MatrixView& A);
/// R as above and the first rows of Q'b, as many as R has.
struct RotatedEquations {
    Matrix R;
    Vector rotated;
};
RotatedEquations rotate_equations(const MatrixView& A, const VectorView& b);
/// Q of A = Q R with all its columns, those beyond A's an orthonormal basis of what A does not span.
Matrix full_orthogonal_basis(const MatrixView& A);
/// The least-squares solution of A X = B: A of full rank in the first, the shortest one in the second.
Matrix solve_by_pivoted_qr(const MatrixView& A, const MatrixView& B);
Matrix minimum_norm_solution(const MatrixView& A, const MatrixView& B);

/// The lower triangle L of A = L L' for a symmetric positive definite A; nothing for another.
std::optional<Matrix> cholesky_root(const MatrixView& A);
/// The solution of A X = B for a symmetric positive definite A, and the reciprocal of its condition number; nothing for
/// another A.
struct SquareSolution {
    Matrix x;
    double reciprocal_condition = 0;
};
std::optional<SquareSolution> solve_by_cholesky(const MatrixView& A, const MatrixView& B);
/// The solution of A X = B for a symmetric positive semidefinite A (L D L').
Vector solve_semidefinite(const MatrixView& A, const VectorView& b);

/// The solution of A X = B for a square A by LU decomposition with row pivots; without meaning where the reciprocal of
/// the condition number (in the 1-norm, estimated) is 0.
SquareSolution solve_by_lu(const MatrixView& A, const MatrixView& B);
/// Nothing for a singular A.
std::optional<Eigen::MatrixXcd> inverse_of_regular(const Eigen::MatrixXcd& A);

}  // namespace dynlab::inline numerics
