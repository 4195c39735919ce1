#include "numerics/kernels/transfer_sensitivity.h"

#include "numerics/error.h"
#include "numerics/kernels/exact_filter.h"
#include "numerics/kernels/sensitivity_system.h"
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
    const SingleInputSystem system = sensitivity_system(num, den);
    return ExactFilter(discretise(system.A, system.B, system.C, system.D, Ts, hold, delay)).run(u);
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
