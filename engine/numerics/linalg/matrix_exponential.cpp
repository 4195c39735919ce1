#include "numerics/linalg/matrix_exponential.h"

#include <cmath>
#include <optional>
#include <unsupported/Eigen/MatrixFunctions>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/short_step.h"

namespace dynlab::inline numerics {

Matrix matrix_exponential(const MatrixView& A) {
    if (A.rows() != A.cols())
        throw InvalidArgument("matrix exponential: the matrix must be square, but it has {} and {}",
                              plural(A.rows(), "{} row", "{} rows"), plural(A.cols(), "{} column", "{} columns"));
    if (!A.allFinite()) throw InvalidArgument("matrix exponential: the matrix contains a value that is not finite");
    if (A.size() == 0) return A;
    Matrix balanced = A;
    const Vector scale = balance(balanced);
    const Matrix exponential = balanced.exp();
    return scale.asDiagonal() * exponential * scale.cwiseInverse().asDiagonal();
}

namespace {

/// Powers of two that bring the columns below one: large inputs must not make the exponential scale and square more
/// often than A itself needs, for every squaring costs accuracy.
Eigen::RowVectorXd input_scale(const Matrix& B) {
    Eigen::RowVectorXd scale = Eigen::RowVectorXd::Ones(B.cols());
    for (Index j = 0; j < B.cols(); ++j) {
        const double largest = B.rows() > 0 ? B.col(j).cwiseAbs().maxCoeff() : 0;
        if (largest > 1) scale(j) = std::exp2(std::ceil(std::log2(largest)));
    }
    return scale;
}

template <int capacity>
std::optional<StepMatrices> exact_short_step(const MatrixView& A, const MatrixView& B, double h) {
    const int n = static_cast<int>(A.rows());
    StateMatrix<capacity> small;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) small(i, j) = A(i, j);
    const auto step = short_step(small, n, h);
    if (!step) return {};
    StepMatrices all{Matrix(n, n), Matrix(n, B.cols()), Matrix(n, B.cols()), Matrix(n, B.cols())};
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) all.F(i, j) = step->E(i, j) + (i == j ? 1 : 0);
    for (Index j = 0; j < B.cols(); ++j) {
        StateVector<capacity> input;
        for (int i = 0; i < n; ++i) input[i] = B(i, j);
        const StateVector<capacity> constant = product(step->W, input, n), ramp = product(step->R, input, n);
        for (int i = 0; i < n; ++i) {
            all.G(i, j) = constant[i];
            all.H1(i, j) = ramp[i];
            all.H0(i, j) = constant[i] - ramp[i];
        }
    }
    return all;
}

}  // namespace

StepMatrices exact_step(const MatrixView& A, const MatrixView& B, double h) {
    std::optional<StepMatrices> short_one;
    if (A.rows() <= 2)
        short_one = exact_short_step<2>(A, B, h);
    else if (A.rows() <= 4)
        short_one = exact_short_step<4>(A, B, h);
    else if (A.rows() <= 8)
        short_one = exact_short_step<8>(A, B, h);
    if (short_one) return *std::move(short_one);
    // In steps of h, with s = t/h: d/ds [x; a; b - a] = [hA hB 0; 0 0 I; 0 0 0] [x; a; b - a].
    const Index n = A.rows(), m = B.cols();
    const Eigen::RowVectorXd scale = input_scale(h * B);
    Matrix block = Matrix::Zero(n + 2 * m, n + 2 * m);
    block.topLeftCorner(n, n) = h * A;
    block.block(0, n, n, m) = h * B * scale.cwiseInverse().asDiagonal();
    block.block(n, n + m, m, m).setIdentity();
    const Matrix exponential = matrix_exponential(block);
    StepMatrices step;
    step.F = exponential.topLeftCorner(n, n);
    step.G = exponential.block(0, n, n, m) * scale.asDiagonal();
    step.H1 = exponential.block(0, n + m, n, m) * scale.asDiagonal();
    step.H0 = step.G - step.H1;
    return step;
}

}  // namespace dynlab::inline numerics
