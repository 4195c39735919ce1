#include "numerics/linalg/matrix_exponential.h"

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <unsupported/Eigen/MatrixFunctions>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/short_step.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

Matrix matrix_exponential(const MatrixView& A) {
    if (A.rows() != A.cols())
        throw InvalidArgument("matrix exponential: the matrix must be square, but it has " + counted(A.rows(), "row") +
                              " and " + counted(A.cols(), "column"));
    if (!A.allFinite()) throw InvalidArgument("matrix exponential: the matrix holds a value that is not finite");
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

template <int n>
std::optional<StepMatrices> short_step_of(const MatrixView& A, const MatrixView& B, double h) {
    using Inputs = Eigen::Matrix<double, n, Eigen::Dynamic>;
    const auto step = short_step<n, Eigen::Dynamic>(A, Inputs(B), h);
    if (!step) return {};
    return StepMatrices{step->F, step->G, step->H0, step->H1};
}

/// For the numbers of states that one to four poles have, alone and in series.
std::optional<StepMatrices> short_step_of(const MatrixView& A, const MatrixView& B, double h) {
    switch (A.rows()) {
        case 1:
            return short_step_of<1>(A, B, h);
        case 2:
            return short_step_of<2>(A, B, h);
        case 3:
            return short_step_of<3>(A, B, h);
        case 4:
            return short_step_of<4>(A, B, h);
        case 6:
            return short_step_of<6>(A, B, h);
        case 8:
            return short_step_of<8>(A, B, h);
        default:
            return {};
    }
}

}  // namespace

StepMatrices exact_step(const MatrixView& A, const MatrixView& B, double h) {
    if (std::optional<StepMatrices> step = short_step_of(A, B, h)) return *std::move(step);
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
