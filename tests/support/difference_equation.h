#pragma once
#include "numerics/models/polynomial_model.h"
#include "numerics/signals/iddata.h"
#include "numerics/signals/random.h"

namespace dynlab::test {

/// p(q) signal, with p = [p_0 p_1 ..] the weights of the present sample, the one before, ..., and zeros before the
/// first.
inline Vector weighted_past(const Vector& p, const Vector& signal) {
    Vector sum = Vector::Zero(signal.size());
    for (Index k = 0; k < signal.size(); ++k)
        for (Index i = 0; i < p.size() && i <= k; ++i) sum[k] += p[i] * signal[k - i];
    return sum;
}

/// The x with p(q) x = signal, sample by sample.
inline Vector divided_by(const Vector& p, const Vector& signal) {
    Vector x = signal;
    for (Index k = 0; k < x.size(); ++k)
        for (Index i = 1; i < p.size() && i <= k; ++i) x[k] -= p[i] * x[k - i];
    return x;
}

/// Measured output of the model for inputs `u` (a column each) and noise `e`, from zero past.
inline Vector model_output(const PolynomialModel& model, const Matrix& u, const Vector& e) {
    Vector sum = divided_by(model.D, weighted_past(model.C, e));
    for (std::size_t i = 0; i < model.B.size(); ++i)
        sum += divided_by(model.F[i], weighted_past(model.B[i], u.col(static_cast<Index>(i))));
    return divided_by(model.A, sum);
}

/// Levels -1 and 1 that last `hold` samples, by the signs of seeded normal numbers.
inline Vector random_levels(Index N, Index hold, std::uint32_t seed) {
    const Vector noise = RandomStream(seed).normal(N);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = noise[k / hold] > 0 ? 1 : -1;
    return u;
}

}  // namespace dynlab::test
