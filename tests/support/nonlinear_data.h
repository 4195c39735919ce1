#pragma once
#include "numerics/signals/iddata.h"
#include "numerics/signals/random.h"

namespace dynlab::test {

/// States of an autonomous system every `step` s, by Runge and Kutta's fourth-order method with 50 steps between
/// samples.
template <class Rate>
inline IdData autonomous_data(Rate rate, Vector x, double step, Index N) {
    Matrix states(N, x.size());
    const double h = step / 50;
    for (Index k = 0; k < N; ++k) {
        states.row(k) = x.transpose();
        for (int i = 0; i < 50; ++i) {
            const Vector a = rate(x), b = rate(x + h / 2 * a), c = rate(x + h / 2 * b), d = rate(x + h * c);
            x += h / 6 * (a + 2 * b + 2 * c + d);
        }
    }
    return IdData(states, Matrix(N, 0), step);
}

/// Lorenz (1963): sigma 10, rho 28, beta 8/3.
inline IdData lorenz_data(double step, Index N) {
    return autonomous_data(
        [](const Vector& x) {
            return Vector{{10 * (x[1] - x[0]), x[0] * (28 - x[2]) - x[1], x[0] * x[1] - 8.0 / 3 * x[2]}};
        },
        Vector{{-8, 8, 27}}, step, N);
}

/// Lotka and Volterra: prey 1.1 x - 0.4 x y, predators 0.1 x y - 0.4 y.
inline IdData lotka_volterra_data(double step, Index N) {
    return autonomous_data(
        [](const Vector& x) {
            return Vector{{1.1 * x[0] - 0.4 * x[0] * x[1], 0.1 * x[0] * x[1] - 0.4 * x[1]}};
        },
        Vector{{10, 5}}, step, N);
}

/// The same with white noise of so many times each state's standard deviation.
inline IdData with_relative_noise(IdData data, double share, std::uint32_t seed) {
    RandomStream chance(seed);
    for (Experiment& experiment : data.experiments)
        for (auto column : experiment.y.colwise()) {
            const double deviation = std::sqrt((column.array() - column.mean()).square().mean());
            column += share * deviation * chance.normal(column.size());
        }
    return data;
}

}  // namespace dynlab::test
