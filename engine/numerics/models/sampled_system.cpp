#include "numerics/models/sampled_system.h"

#include <cmath>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

/// The weights of the two samples around a piece of the sampling interval: the input there runs from
/// (1-start) a + start b to (1-end) a + end b for foh, and stays a for zoh.
struct PieceWeights {
    Vector left, right;
};

PieceWeights piece_weights(const StepMatrices& step, Hold hold, double start, double end) {
    if (hold == Hold::kZoh) return {step.G.col(0), Vector::Zero(step.G.rows())};
    return {(1 - start) * step.H0.col(0) + (1 - end) * step.H1.col(0), start * step.H0.col(0) + end * step.H1.col(0)};
}

}  // namespace

SplitDelay split_delay(double delay, double Ts) {
    constexpr double kRounding = 1e-9;
    const double samples = delay / Ts, nearest = std::round(samples);
    if (std::abs(samples - nearest) <= kRounding * std::max(1.0, nearest)) return {static_cast<Index>(nearest), 0};
    const double whole = std::floor(samples);
    return {static_cast<Index>(whole), delay - whole * Ts};
}

SampledSystem discretize(const MatrixView& A, const VectorView& B, const MatrixView& C, const VectorView& D, double Ts,
                         Hold hold, double delay) {
    // In [k Ts, k Ts + rest) the delayed input lies between u[k-d-1] and u[k-d], afterwards between u[k-d] and
    // u[k-d+1]; the rest of the delay is the fraction `late` of an interval.
    const auto [samples, rest] = split_delay(delay, Ts);
    const double late = rest / Ts;
    const StepMatrices second = exact_step(A, B, Ts - rest);
    const PieceWeights after = piece_weights(second, hold, 0, 1 - late);
    SampledSystem system;
    system.delay = samples;
    system.C = C;
    system.G.resize(A.rows(), 3);
    system.first_G.resize(A.rows(), 2);
    system.first_G << after.right, after.left;
    system.D.resize(C.rows(), 2);
    if (rest == 0) {
        system.F = second.F;
        system.G << after.right, after.left, Vector::Zero(A.rows());
        system.D << D, Vector::Zero(C.rows());
        system.first_D = D;
        return system;
    }
    const StepMatrices first = exact_step(A, B, rest);
    const PieceWeights before = piece_weights(first, hold, 1 - late, 1);
    system.F = second.F * first.F;
    system.G << after.right, after.left + second.F * before.right, second.F * before.left;
    const double newer = hold == Hold::kZoh ? 0 : 1 - late;
    system.D << newer * D, (1 - newer) * D;
    system.first_D = Vector::Zero(C.rows());
    return system;
}

SampledSystem discrete_system(const MatrixView& A, const VectorView& B, const MatrixView& C, const VectorView& D,
                              Index delay) {
    SampledSystem system;
    system.F = A;
    system.G = Matrix::Zero(A.rows(), 3);
    system.G.col(1) = B;
    system.first_G = system.G.leftCols(2);
    system.C = C;
    system.D = Matrix::Zero(C.rows(), 2);
    system.D.col(0) = D;
    system.first_D = D;
    system.delay = delay;
    return system;
}

SampledSystem derivative_filter(const VectorView& den, double Ts, Hold hold, double delay) {
    const Index n = den.size() - 1;
    Matrix C(n + 1, n);
    C << -den.tail(n).transpose(), Matrix::Identity(n, n);
    const Vector B = Vector::Unit(n, 0), D = Vector::Unit(n + 1, 0);
    return discretize(companion(den), B, C, D, Ts, hold, delay);
}

}  // namespace dynlab::inline numerics
