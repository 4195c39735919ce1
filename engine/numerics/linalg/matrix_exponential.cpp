#include "numerics/linalg/matrix_exponential.h"

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <unsupported/Eigen/MatrixFunctions>

#include "numerics/error.h"
#include "numerics/linalg/balance.h"

namespace dynlab {

Matrix matrix_exponential(const MatrixView& A) {
    if (A.rows() != A.cols())
        throw InvalidArgument("matrix exponential: the matrix must be square, but it has " + std::to_string(A.rows()) +
                              " rows and " + std::to_string(A.cols()) + " columns");
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

/// A short step of n states by Taylor's series of phi_2(Z) = sum_k Z^k/(k+2)!, Z = hA (Higham 2008, section 10.7.4):
///     phi_1 = I + Z phi_2,   F = I + Z phi_1,   G = h phi_1 B,   H1 = h phi_2 B.
/// Nothing when the step is too long for that.
template <int n>
std::optional<StepMatrices> short_step(const MatrixView& A, const MatrixView& B, double h) {
    constexpr double kLongest = 0.5, kNegligible = 1e-18;
    using Square = Eigen::Matrix<double, n, n>;
    Square Z = h * A;
    const Eigen::Matrix<double, n, 1> scale = balance(Z);
    const double size = Z.cwiseAbs().colwise().sum().maxCoeff();
    if (!(size <= kLongest)) return {};
    int terms = 1;
    for (double term = size / 3; term > kNegligible; term *= size / (terms + 2)) ++terms;
    const Square identity = Square::Identity();
    Square phi2 = identity;
    for (int k = terms; k > 0; --k) phi2 = identity + Z / (k + 2) * phi2;
    phi2 /= 2;
    const Square phi1 = identity + Z.lazyProduct(phi2), F = identity + Z.lazyProduct(phi1);
    const Matrix input = scale.cwiseInverse().asDiagonal() * (h * B);
    StepMatrices step;
    step.F = scale.asDiagonal() * F * scale.cwiseInverse().asDiagonal();
    step.G = scale.asDiagonal() * phi1.lazyProduct(input);
    step.H1 = scale.asDiagonal() * phi2.lazyProduct(input);
    step.H0 = step.G - step.H1;
    return step;
}

/// For the numbers of states that one and two poles have, alone and in series.
std::optional<StepMatrices> short_step(const MatrixView& A, const MatrixView& B, double h) {
    switch (A.rows()) {
        case 1:
            return short_step<1>(A, B, h);
        case 2:
            return short_step<2>(A, B, h);
        case 4:
            return short_step<4>(A, B, h);
        default:
            return {};
    }
}

}  // namespace

StepMatrices exact_step(const MatrixView& A, const MatrixView& B, double h) {
    if (std::optional<StepMatrices> step = short_step(A, B, h)) return *std::move(step);
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

}  // namespace dynlab
