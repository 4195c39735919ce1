#pragma once
#include <cmath>

#include "support/transfer_cases.h"

namespace dynlab::test {

/// C/D x from rest.
inline Vector arma_filtered(const Vector& C, const Vector& D, const Vector& x) {
    Vector v = Vector::Zero(x.size());
    for (Index k = 0; k < v.size(); ++k) {
        for (Index j = 0; j < C.size() && j <= k; ++j) v[k] += C[j] * x[k - j];
        for (Index i = 1; i < D.size() && i <= k; ++i) v[k] -= D[i] * v[k - i];
    }
    return v;
}

/// v = C/D e with the e of a seed, settled before its first sample.
inline Vector arma_signal(const Vector& C, const Vector& D, Index N, std::uint32_t seed) {
    constexpr Index kSettling = 200;
    return arma_filtered(C, D, RandomStream(seed).normal(N + kSettling)).tail(N);
}

/// The classic problem, 2/(s^2 + 4s + 3), prbs(7, 8), Ts = 0.05 s, N = 1016, with noise C/D e of a signal-to-noise
/// ratio of 15 dB: (1 + 0.9 q^-1)/(1 - q^-1 + 0.2 q^-2) in the published problem.
struct ColoredProblem {
    Vector C = values({1, 0.9}), D = values({1, -1, 0.2});
    Vector u = prbs(7, 8);
    Vector x = lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.05);

    /// Standard deviation of e.
    double sigma() const {
        const double of_x = std::sqrt((x.array() - x.mean()).square().mean());
        return of_x * std::pow(10, -15.0 / 20) / arma_filtered(C, D, Vector::Unit(1000, 0)).norm();
    }
    IdData simulated_data(std::uint32_t seed) const {
        return IdData(Matrix(x + sigma() * arma_signal(C, D, u.size(), seed)), Matrix(u), 0.05);
    }
};

}  // namespace dynlab::test
