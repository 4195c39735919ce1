#include "numerics/filters/sensitivity_system.h"

#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

/// A signal as a function of the state and the input.
struct LinearOutput {
    Eigen::RowVectorXd state;
    double input = 0;
};

/// The r-th derivative of z, r = 0 .. n, from A(p) z = u.
LinearOutput derivative_of_z(const VectorView& den, Index r) {
    const Index n = den.size() - 1;
    LinearOutput output{Eigen::RowVectorXd::Zero(2 * n)};
    if (r < n) {
        output.state[n - 1 - r] = 1;
    } else {
        output.state.head(n) = -den.tail(n).transpose();
        output.input = 1;
    }
    return output;
}

/// Row r: the r-th derivative of w as a function of the state, r = 0 .. 2n-1, from A(p) w = z.
Matrix derivatives_of_w(const VectorView& den) {
    const Index n = den.size() - 1;
    Matrix rows = Matrix::Zero(2 * n, 2 * n);
    for (Index r = 0; r < n; ++r) rows(r, 2 * n - 1 - r) = 1;
    for (Index r = n; r < 2 * n; ++r) {
        rows(r, 2 * n - 1 - r) = 1;  // the (r-n)-th derivative of z
        for (Index i = 1; i <= n; ++i) rows.row(r) -= den[i] * rows.row(r - i);
    }
    return rows;
}

}  // namespace

Matrix cascade_matrix(const VectorView& den, Index r) {
    const Index n = den.size() - 1;
    Matrix cascade = Matrix::Zero(2 * n, 2 * n);
    cascade.topLeftCorner(n, n) = companion(den);
    cascade.bottomRightCorner(n, n) = companion(den);
    cascade(n, n - 1 - r) = 1;
    return cascade;
}

SingleInputSystem sensitivity_system(const VectorView& num, const VectorView& den) {
    const Index n = den.size() - 1, m = num.size() - 1, outputs = n + m + 3;
    const Matrix w = derivatives_of_w(den);
    SingleInputSystem system{cascade_matrix(den, 0), Vector::Unit(2 * n, 0), Matrix::Zero(outputs, 2 * n),
                             Vector::Zero(outputs)};
    for (Index j = 0; j <= m; ++j) {
        const LinearOutput z = derivative_of_z(den, m - j);
        system.C.row(n + 1 + j) = z.state;
        system.D[n + 1 + j] = z.input;
        system.C.row(0) += num[j] * z.state;
        system.D[0] += num[j] * z.input;
        for (Index i = 1; i <= n; ++i) system.C.row(i) -= num[j] * w.row(n - i + m - j);
    }
    system.C.row(outputs - 1) = -system.C.row(0) * system.A;
    system.D[outputs - 1] = -system.C.row(0).dot(system.B);
    return system;
}

}  // namespace dynlab::inline numerics
