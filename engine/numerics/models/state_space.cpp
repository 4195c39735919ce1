#include "numerics/models/state_space.h"

#include <cmath>
#include <utility>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

namespace {

void check_matrix(const Matrix& matrix, const char* name, Index rows, Index columns) {
    if (matrix.rows() != rows || matrix.cols() != columns)
        throw InvalidArgument("state space: {} must be {} x {}, but it is {} x {}", name, rows, columns, matrix.rows(),
                              matrix.cols());
    if (!matrix.allFinite()) throw InvalidArgument("state space: {} contains a value that is not finite", name);
}

/// One input, one output, seen through its zeros: c (sI-A)^-1 b + d = gain prod(s - zeros)/det(sI-A).
struct ZerosAndGain {
    ComplexVector zeros;
    double gain = 0;
};

ComplexVector balanced_eigenvalues(Matrix A) {
    if (A.rows() == 0) return ComplexVector();
    balance(A);
    return eigenvalues(A);
}

/// The output and its derivatives up to the first that the input reaches directly must vanish: the zeros are the
/// eigenvalues of the motion left inside that null space (zero dynamics; Isidori 1995, section 4.3).
ZerosAndGain zeros_and_gain(const Matrix& A, const Vector& b, const Eigen::RowVectorXd& c, double d) {
    constexpr double kRounding = 1e-13;
    if (std::abs(d) > kRounding * c.stableNorm() * b.stableNorm()) return {balanced_eigenvalues(A - b * c / d), d};
    const Index n = A.rows();
    Matrix derivatives(0, n);
    Eigen::RowVectorXd row = c;
    for (Index degree = 1; degree <= n; ++degree) {
        derivatives.conservativeResize(degree, n);
        derivatives.row(degree - 1) = row.stableNorm() > 0 ? Eigen::RowVectorXd(row.normalized()) : row;
        const double gain = row.dot(b.transpose());
        if (std::abs(gain) > kRounding * row.stableNorm() * b.stableNorm()) {
            const Matrix inner = A - b * (row * A) / gain;
            const Matrix Q = full_orthogonal_basis(derivatives.transpose());
            const Matrix null_space = Q.rightCols(n - degree);
            return {balanced_eigenvalues(null_space.transpose() * inner * null_space), gain};
        }
        row = row * A;
    }
    return {};
}

}  // namespace

StateSpace::StateSpace(Matrix A_, Matrix B_, Matrix C_, Matrix D_, double Ts_)
    : A(std::move(A_)), B(std::move(B_)), C(std::move(C_)), D(std::move(D_)), Ts(Ts_) {
    check_matrix(A, "A", A.rows(), A.rows());
    check_matrix(B, "B", A.rows(), B.cols());
    check_matrix(C, "C", C.rows(), A.rows());
    check_matrix(D, "D", C.rows(), B.cols());
    if (!(Ts >= 0) || !std::isfinite(Ts))
        throw InvalidArgument(
            "state space: Ts must be a positive number of seconds, or 0 for continuous time, but it is {}", Ts);
}

StateSpace to_state_space(const TransferFunction& G) {
    if (!G.proper())
        throw InvalidArgument(
            "a transfer function with {} and {} is improper and has no state-space form; it needs at least as many "
            "poles as zeros",
            plural(G.zero_count(), "{} zero", "{} zeros"), plural(G.pole_count(), "{} pole", "{} poles"));
    const Index n = G.pole_count();
    Vector num = Vector::Zero(n + 1);
    num.tail(G.num().size()) = G.num();
    Matrix B = Matrix::Zero(n, 1);
    if (n > 0) B(0, 0) = 1;
    const Matrix C = (num.tail(n) - num(0) * G.den().tail(n)).transpose();
    return StateSpace(companion(G.den()), B, C, Matrix::Constant(1, 1, num(0)), G.Ts());
}

TransferFunction to_transfer_function(const StateSpace& system, Index output, Index input) {
    if (output < 0 || output >= system.C.rows() || input < 0 || input >= system.B.cols())
        throw InvalidArgument("state space: output {} or input {} does not exist; the system has {} and {}", output + 1,
                              input + 1, plural(system.C.rows(), "{} output", "{} outputs"),
                              plural(system.B.cols(), "{} input", "{} inputs"));
    const Vector den = polynomial_from_roots(balanced_eigenvalues(system.A));
    const auto [zeros, gain] =
        zeros_and_gain(system.A, system.B.col(input), system.C.row(output), system.D(output, input));
    return TransferFunction(gain * polynomial_from_roots(zeros), den, system.Ts);
}

}  // namespace dynlab::inline numerics
