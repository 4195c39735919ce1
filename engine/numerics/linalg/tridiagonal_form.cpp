#include "numerics/linalg/tridiagonal_form.h"

#include <Eigen/Eigenvalues>

namespace dynlab::inline numerics {

TridiagonalForm tridiagonal_form(const MatrixView& A, const VectorView& b) {
    if (A.rows() == 1) return {A.diagonal(), Vector(), b};
    const Eigen::Tridiagonalization<Matrix> form(A);
    return {form.diagonal(), form.subDiagonal(), form.matrixQ().adjoint() * b};
}

}  // namespace dynlab::inline numerics
