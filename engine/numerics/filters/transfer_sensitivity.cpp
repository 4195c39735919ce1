#include "numerics/filters/transfer_sensitivity.h"

#include <algorithm>

#include "numerics/error.h"
#include "numerics/filters/sensitivity_system.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/sampled_system.h"
#include "numerics/simulation/exact_filter.h"
#include "numerics/simulation/irregular_filter.h"

namespace dynlab::inline numerics {

namespace {

void require_proper(const VectorView& num, const VectorView& den) {
    if (num.size() < 1 || den.size() < 2 || num.size() > den.size())
        throw InvalidArgument(
            "A proper transfer function is required: at least one pole, and no more zeros than poles");
}

SingleInputSystem response_system(const VectorView& num, const VectorView& den) {
    const Index n = den.size() - 1;
    SingleInputSystem system{companion(den), Vector::Unit(n, 0), Matrix::Zero(1, n), Vector::Zero(1)};
    if (num.size() <= n) {
        system.C.rightCols(num.size()) = num.transpose();
    } else {
        system.C = (num.tail(n) - num[0] * den.tail(n)).transpose();
        system.D[0] = num[0];
    }
    return system;
}

Matrix run(const SingleInputSystem& system, double delay, const VectorView& u, double Ts, Hold hold) {
    return ExactFilter(discretize(system.A, system.B, system.C, system.D, Ts, hold, delay)).run(u);
}

Matrix run(const SingleInputSystem& system, double delay, const VectorView& u, const VectorView& t, Hold hold) {
    return IrregularFilter(system.A, system.B, system.C, system.D, hold, delay)
        .run(u, t, Vector::Zero(system.A.rows()));
}

// Slopes of the linear interpolation of u at the instants t - delay; zero before the first sample.
Vector delayed_slope(const VectorView& u, const VectorView& t, double delay) {
    const Index N = u.size();
    Vector slope = Vector::Zero(N);
    if (N < 2) return slope;
    const double rounding = 1e-9 * (t[N - 1] - t[0]) / static_cast<double>(N - 1);
    Index next = 0;  // the first sample after t[k] - delay
    for (Index k = 0; k < N; ++k) {
        while (next < N && t[next] <= t[k] - delay + rounding) ++next;
        if (next == 0) continue;
        const Index right = std::min(next, N - 1);
        slope[k] = (u[right] - u[right - 1]) / (t[right] - t[right - 1]);
    }
    return slope;
}

// With m = n the input itself is part of the output: its slope belongs to the derivative by the delay.
void add_direct_slope(Matrix& sensitivities, const VectorView& num, const VectorView& den, double delay,
                      const VectorView& u, const VectorView& t, Hold hold) {
    if (num.size() == den.size() && hold == Hold::kFoh)
        sensitivities.rightCols(1) -= num[0] * delayed_slope(u, t, delay);
}

// The last state of dx/dt = A x as the one output of a filter without input.
ExactFilter free_motion(const Matrix& A, double Ts) {
    const Index n = A.rows();
    const Matrix F = exact_step(A, Matrix::Zero(n, 1), Ts).F, C = Vector::Unit(n, n - 1).transpose();
    return ExactFilter(discrete_system(F, Vector::Zero(n), C, Vector::Zero(1), 0));
}

IrregularFilter irregular_free_motion(const Matrix& A) {
    const Index n = A.rows();
    return IrregularFilter(A, Vector::Unit(n, 0), Vector::Unit(n, n - 1).transpose(), Vector::Zero(1), Hold::kZoh);
}

// The state of cascade_matrix from which the free response with these initial values drives the second half.
Vector sensitivity_start(const VectorView& initial) {
    const Index n = initial.size();
    Vector state = Vector::Zero(2 * n);
    state.head(n) = -initial.reverse();
    return state;
}

}  // namespace

Vector transfer_response(const VectorView& num, const VectorView& den, double delay, const VectorView& u, double Ts,
                         Hold hold) {
    require_proper(num, den);
    return run(response_system(num, den), delay, u, Ts, hold);
}

Vector transfer_response(const VectorView& num, const VectorView& den, double delay, const VectorView& u,
                         const VectorView& t, Hold hold) {
    require_proper(num, den);
    return run(response_system(num, den), delay, u, t, hold);
}

Matrix transfer_sensitivities(const VectorView& num, const VectorView& den, double delay, const VectorView& u,
                              double Ts, Hold hold) {
    require_proper(num, den);
    Matrix sensitivities = run(sensitivity_system(num, den), delay, u, Ts, hold);
    const Vector t = Ts * Vector::LinSpaced(u.size(), 0, static_cast<double>(u.size() - 1));
    add_direct_slope(sensitivities, num, den, delay, u, t, hold);
    return sensitivities;
}

Matrix transfer_sensitivities(const VectorView& num, const VectorView& den, double delay, const VectorView& u,
                              const VectorView& t, Hold hold) {
    require_proper(num, den);
    Matrix sensitivities = run(sensitivity_system(num, den), delay, u, t, hold);
    add_direct_slope(sensitivities, num, den, delay, u, t, hold);
    return sensitivities;
}

Matrix free_responses(const VectorView& den, Index N, double Ts) {
    const Index n = den.size() - 1;
    const ExactFilter motion = free_motion(companion(den), Ts);
    Matrix responses(N, n);
    for (Index j = 0; j < n; ++j) motion.run(Vector::Zero(N), Vector::Unit(n, n - 1 - j), responses.col(j));
    return responses;
}

Matrix free_responses(const VectorView& den, const VectorView& t) {
    const Index n = den.size() - 1, N = t.size();
    IrregularFilter motion = irregular_free_motion(companion(den));
    Matrix responses(N, n);
    for (Index j = 0; j < n; ++j) responses.col(j) = motion.run(Vector::Zero(N), t, Vector::Unit(n, n - 1 - j));
    return responses;
}

// A(p) y = 0 with y(0), dy/dt(0), ... given, so A(p) dy/da_i = -p^(n-i) y from rest.
Matrix free_sensitivities(const VectorView& den, const VectorView& initial, Index N, double Ts) {
    const Index n = den.size() - 1;
    Matrix sensitivities(N, n);
    for (Index i = 1; i <= n; ++i)
        free_motion(cascade_matrix(den, n - i), Ts)
            .run(Vector::Zero(N), sensitivity_start(initial), sensitivities.col(i - 1));
    return sensitivities;
}

Matrix free_sensitivities(const VectorView& den, const VectorView& initial, const VectorView& t) {
    const Index n = den.size() - 1, N = t.size();
    Matrix sensitivities(N, n);
    for (Index i = 1; i <= n; ++i)
        sensitivities.col(i - 1) =
            irregular_free_motion(cascade_matrix(den, n - i)).run(Vector::Zero(N), t, sensitivity_start(initial));
    return sensitivities;
}

}  // namespace dynlab::inline numerics
