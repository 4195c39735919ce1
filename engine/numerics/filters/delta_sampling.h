#pragma once
#include <algorithm>

#include "numerics/filters/delta_chain.h"
#include "numerics/filters/delta_expansion.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/short_step.h"
#include "numerics/models/sampled_system.h"

namespace dynlab::inline numerics {

// Continuous-time systems as delta chains, exactly for held inputs (zoh) and inputs on straight lines (foh), with any
// delay (s); the number of states is known to the compiler, so that sampling does not take longer than a short record.

/// One sampling interval of dx/dt = A x + [1; 0; ..] u(t - delay), with w the samples of u from the instant `begin` on:
///     x[k+1] = x[k] + E x[k] + after_next w[k+2] + next w[k+1] + now w[k].
/// At `begin`, where w starts, x is `first` times the first sample, and after_next times the second.
template <int n>
struct DelayedStep {
    StateMatrix<n> E;
    StateVector<n> after_next, next, now, first;
    Index begin = 0;
    bool between = false;       ///< the delay ends between samples: w is one sample late
    double weight_of_next = 0;  ///< of w[k+1] in u at the instant k; the rest is that of w[k]
};

/// exp(A h) and the integrals over inputs on straight lines, for h seconds of dx/dt = A x + [1; 0; ..] u.
template <int n>
SizedStep<n, 1> step_of(const StateMatrix<n>& A, double h) {
    const StateVector<n> input = StateVector<n>::Unit(0);
    if (const auto step = short_step<n, 1>(A, input, h)) return *step;
    const StepMatrices step = exact_step(A, input, h);
    return {step.F, step.G, step.H0, step.H1, step.F - Matrix::Identity(n, n)};
}

/// The step of the first states alone, which the others do not act upon.
template <int n, int all>
SizedStep<n, 1> step_of_first(const SizedStep<all, 1>& step) {
    return {step.F.template topLeftCorner<n, n>(), step.G.template head<n>(), step.H0.template head<n>(),
            step.H1.template head<n>(), step.E.template topLeftCorner<n, n>()};
}

/// The step of Ts seconds for an input that comes `delay` seconds late; `whole` is that without delay.
template <int n>
DelayedStep<n> delayed_step(const StateMatrix<n>& A, const SizedStep<n, 1>& whole, double Ts, Hold hold, double delay) {
    const auto [samples, rest] = split_delay(delay, Ts);
    const bool held = hold == Hold::kZoh;
    DelayedStep<n> step;
    step.begin = samples;
    step.after_next.setZero();
    step.first.setZero();
    if (rest == 0) {
        step.E = whole.E;
        step.next.setZero();
        if (!held) step.next = whole.H1;
        step.now = held ? whole.G : whole.H0;
        return step;
    }
    // In the first `late` of the interval, u runs from w[k] towards w[k+1], then on towards w[k+2].
    const double late = rest / Ts;
    const SizedStep<n, 1> first = step_of<n>(A, rest), second = step_of<n>(A, Ts - rest);
    StateVector<n> before = StateVector<n>::Zero();
    if (held) {
        step.first = second.G;
        step.now = first.G;
    } else {
        step.after_next = (1 - late) * second.H1;
        step.first = second.H0 + late * second.H1;
        step.now = late * first.H0;
        before = (1 - late) * first.H0 + first.H1;
        step.weight_of_next = 1 - late;
    }
    step.E = second.E + first.E + second.E.lazyProduct(first.E);
    step.next = step.first + before + second.E.lazyProduct(before);
    step.now += second.E.lazyProduct(step.now).eval();
    ++step.begin;
    step.between = true;
    return step;
}

/// A signal's chain, and outputs as combinations of its columns.
struct DeltaSignal {
    DeltaChain chain;
    ColumnMatrix outputs;
};

/// y = C x + D u for the system of `step`, `expand` being one of the expansions above. `longer`: as a chain of n + 1
/// columns, which inputs on straight lines with a delay between samples need.
template <int n, class Outputs, class Direct, class Expand>
DeltaSignal delta_signal(const DelayedStep<n>& step, const Expand& expand, const Outputs& C, const Direct& D,
                         const Eigen::Map<const Vector>& u, bool longer) {
    // x = after_next w[k+1] + g w[k] + T [X_0 .. X_(n-1)]
    const StateVector<n> g = step.next + step.after_next + step.E.lazyProduct(step.after_next);
    const auto [alpha, T] = expand(step.E, StateVector<n>(g + step.E.lazyProduct(g) + step.now));
    DeltaSignal signal;
    DeltaChain& chain = signal.chain;
    ColumnMatrix& outputs = signal.outputs;
    const Index p = C.rows();
    outputs.setZero(p, longer ? n + 2 : n + 1);
    outputs.template leftCols<n>() = C.lazyProduct(T);
    // w = X_n + sum alpha_j X_j, and so w[k+1] of the longer chain, which has a pole at q = 0 more.
    const auto weights_of_w = (C.lazyProduct(g) + (1 - step.weight_of_next) * D).eval();
    for (int j = 0; j < n; ++j) outputs.col(j) += alpha[j] * weights_of_w;
    outputs.col(n) += weights_of_w;
    std::copy_n(alpha.data(), n, chain.alpha.data());
    chain.order = n;
    chain.samples = u.data();
    chain.count = u.size();
    chain.begin = step.begin;
    const StateVector<n> away = u[0] * (step.first - g);
    if (!away.isZero(0)) {
        const StateVector<n> start = scaled_solution<n>(T, away);
        std::copy_n(start.data(), n, chain.start.data());
    }
    if (!longer) return signal;
    double first = u[0];
    for (int j = 0; j < n; ++j) first -= alpha[j] * chain.start[static_cast<std::size_t>(j)];
    chain.start[n] = first;
    chain.alpha[n] = 1;
    for (int j = n; j > 0; --j)
        chain.alpha[static_cast<std::size_t>(j)] += chain.alpha[static_cast<std::size_t>(j - 1)];
    const auto weights_of_next = (C.lazyProduct(step.after_next) + step.weight_of_next * D).eval();
    for (int j = 0; j <= n; ++j) outputs.col(j) += chain.alpha[static_cast<std::size_t>(j)] * weights_of_next;
    outputs.col(n + 1) += weights_of_next;
    chain.order = n + 1;
    ++chain.samples;
    --chain.count;
    return signal;
}

}  // namespace dynlab::inline numerics
