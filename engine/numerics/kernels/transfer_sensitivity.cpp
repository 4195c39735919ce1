#include "numerics/kernels/transfer_sensitivity.h"

#include "numerics/error.h"
#include "numerics/kernels/exact_filter.h"
#include "numerics/kernels/tapped_system.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab {

namespace {

void require_strictly_proper(const VectorView& num, const VectorView& den) {
    if (num.size() < 1 || den.size() < 2 || num.size() >= den.size())
        throw InvalidArgument(
            "A strictly proper transfer function is needed: fewer zeros than poles, at least one pole");
}

// d/dt [z; w] with A(p) z = v, A(p) w = p^r z; z and w hold their n-1-st ... 0-th derivatives.
Matrix cascade_matrix(const VectorView& den, Index r) {
    const Index n = den.size() - 1;
    Matrix cascade = Matrix::Zero(2 * n, 2 * n);
    cascade.topLeftCorner(n, n) = companion(den);
    cascade.bottomRightCorner(n, n) = companion(den);
    cascade(n, n - 1 - r) = 1;
    return cascade;
}

// Row r: the r-th derivative of w as a function of [z; w], r = 0 .. 2n-1, from A(p) w = z.
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

// The last state of dx/dt = A x as the one output of a filter without input.
ExactFilter free_motion(const Matrix& A, double Ts) {
    const Index n = A.rows();
    const Matrix F = exact_step(A, Matrix::Zero(n, 1), Ts).F, C = Vector::Unit(n, n - 1).transpose();
    return ExactFilter(tapped(F, Vector::Zero(n), C, Vector::Zero(1), 0));
}

}  // namespace

Vector transfer_response(const VectorView& num, const VectorView& den, double delay, const VectorView& u, double Ts,
                         Hold hold) {
    require_strictly_proper(num, den);
    const Index n = den.size() - 1;
    Matrix C = Matrix::Zero(1, n);
    C.rightCols(num.size()) = num.transpose();
    const TappedSystem system = discretise(companion(den), Vector::Unit(n, 0), C, Vector::Zero(1), Ts, hold, delay);
    return ExactFilter(system).run(u);
}

Matrix transfer_sensitivities(const VectorView& num, const VectorView& den, double delay, const VectorView& u,
                              double Ts, Hold hold) {
    require_strictly_proper(num, den);
    const Index n = den.size() - 1, m = num.size() - 1, outputs = n + m + 3;
    const Matrix cascade = cascade_matrix(den, 0), w = derivatives_of_w(den);
    const Vector input = Vector::Unit(2 * n, 0);
    Matrix C = Matrix::Zero(outputs, 2 * n);
    for (Index j = 0; j <= m; ++j) {
        C(0, n - 1 - (m - j)) = num[j];
        C(n + 1 + j, n - 1 - (m - j)) = 1;
        for (Index i = 1; i <= n; ++i) C.row(i) -= num[j] * w.row(n - i + m - j);
    }
    C.row(outputs - 1) = -C.row(0) * cascade;
    Vector D = Vector::Zero(outputs);
    D[outputs - 1] = -C.row(0).dot(input);
    return ExactFilter(discretise(cascade, input, C, D, Ts, hold, delay)).run(u);
}

Matrix free_responses(const VectorView& den, Index N, double Ts) {
    const Index n = den.size() - 1;
    const ExactFilter motion = free_motion(companion(den), Ts);
    Matrix responses(N, n);
    for (Index j = 0; j < n; ++j) motion.run(Vector::Zero(N), Vector::Unit(n, n - 1 - j), responses.col(j));
    return responses;
}

Matrix free_sensitivities(const VectorView& den, const VectorView& initial, Index N, double Ts) {
    // A(p) y = 0 with y(0), dy/dt(0), ... given, so A(p) dy/da_i = -p^(n-i) y from rest.
    const Index n = den.size() - 1;
    Vector state = Vector::Zero(2 * n);
    state.head(n) = -initial.reverse();
    Matrix sensitivities(N, n);
    for (Index i = 1; i <= n; ++i)
        free_motion(cascade_matrix(den, n - i), Ts).run(Vector::Zero(N), state, sensitivities.col(i - 1));
    return sensitivities;
}

}  // namespace dynlab
