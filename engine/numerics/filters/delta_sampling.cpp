#include "numerics/filters/delta_sampling.h"

#include <algorithm>

#include "numerics/filters/delta_expansion.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/short_step.h"
#include "numerics/models/sampled_system.h"

namespace dynlab::inline numerics {

namespace {

/// The step of h seconds.
template <int capacity>
void set_step(double h, const StateMatrix<capacity>& A, int n, StateMatrix<capacity>& E, StateVector<capacity>& G,
              StateVector<capacity>& H0, StateVector<capacity>& H1) {
    if (const auto step = short_step(A, n, h)) {
        E = step->E;
        G = step->W.column[0];
        H1 = step->R.column[0];
    } else {
        Matrix same(n, n);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) same(i, j) = A(i, j);
        const StepMatrices exact = exact_step(same, Vector::Unit(n, 0), h);
        for (int j = 0; j < n; ++j) {
            G[j] = exact.G(j, 0);
            H1[j] = exact.H1(j, 0);
            for (int i = 0; i < n; ++i) E(i, j) = exact.F(i, j) - (i == j ? 1 : 0);
        }
    }
    H0 = G;
    H0.add(-1, H1);
}

/// One sampling interval of a filter, with w the samples of u from the instant `begin` on:
///     x[k+1] = x[k] + E x[k] + after_next w[k+2] + next w[k+1] + now w[k].
/// At `begin`, where w starts, x is `first` times the first sample, and after_next times the second.
template <int capacity>
struct DelayedStep {
    StateMatrix<capacity> E;
    StateVector<capacity> after_next, next, now, first;
    Index begin = 0;
    double weight_of_next = 0;  ///< of w[k+1] in u at the instant k; the rest is that of w[k]
};

template <int capacity>
StateVector<capacity> sum(StateVector<capacity> a, double weight, const StateVector<capacity>& b) {
    a.add(weight, b);
    return a;
}
/// x + E x
template <int capacity>
StateVector<capacity> moved(const StateMatrix<capacity>& E, const StateVector<capacity>& x, int n) {
    return sum(x, 1, product(E, x, n));
}
template <int capacity>
StateVector<capacity> times(double weight, const StateVector<capacity>& x) {
    return sum(StateVector<capacity>(), weight, x);
}

template <int capacity>
DelayedStep<capacity> delayed_step(const SampledFilter<capacity>& filter, Hold hold, double delay) {
    const int n = filter.states;
    const auto [samples, rest] = split_delay(delay, filter.Ts);
    const bool held = hold == Hold::kZoh;
    DelayedStep<capacity> step;
    step.begin = samples;
    if (rest == 0) {
        step.E = filter.E;
        if (!held) step.next = filter.H1;
        step.now = held ? filter.G : filter.H0;
        return step;
    }
    // In the first `late` of the interval, u runs from w[k] towards w[k+1], then on towards w[k+2].
    const double late = rest / filter.Ts;
    SampledFilter<capacity> first = filter, second = filter;
    set_step(rest, first.A, n, first.E, first.G, first.H0, first.H1);
    set_step(filter.Ts - rest, second.A, n, second.E, second.G, second.H0, second.H1);
    StateVector<capacity> before;
    if (held) {
        step.first = second.G;
        step.now = first.G;
    } else {
        step.after_next = times(1 - late, second.H1);
        step.first = sum(second.H0, late, second.H1);
        step.now = times(late, first.H0);
        before = sum(first.H1, 1 - late, first.H0);
        step.weight_of_next = 1 - late;
    }
    step.E = product(second.E, first.E, n);
    step.E.add(1, second.E, n);
    step.E.add(1, first.E, n);
    step.next = sum(step.first, 1, moved(second.E, before, n));
    step.now = moved(second.E, step.now, n);
    ++step.begin;
    return step;
}

}  // namespace

template <int capacity>
SampledFilter<capacity>::SampledFilter(const VectorView& den, double sampling_time, bool twice)
    : poles(static_cast<int>(den.size()) - 1), states(twice ? 2 * poles : poles), Ts(sampling_time) {
    for (int system = 0; system < states; system += poles) {
        for (int i = 0; i < poles; ++i) A(system, system + i) = -den[i + 1];
        for (int i = 1; i < poles; ++i) A(system + i, system + i - 1) = 1;
    }
    if (twice) A(poles, poles - 1) = 1;
    set_step(Ts, A, states, E, G, H0, H1);
}

template <int capacity>
SampledFilter<4> SampledFilter<capacity>::first() const {
    SampledFilter<4> one;
    one.poles = one.states = poles;
    one.Ts = Ts;
    for (int i = 0; i < poles; ++i) {
        for (int j = 0; j < poles; ++j) {
            one.A(i, j) = A(i, j);
            one.E(i, j) = E(i, j);
        }
        one.G[i] = G[i];
        one.H0[i] = H0[i];
        one.H1[i] = H1[i];
    }
    return one;
}

namespace {

template <int capacity>
StateExpansion<capacity> expansion_of(const SampledFilter<capacity>& filter, const StateMatrix<capacity>& E,
                                      const StateVector<capacity>& input) {
    if constexpr (capacity == 4)
        if (filter.states == filter.poles) return expansion(E, input, filter.poles);
    return cascade_expansion(E, input, filter.poles);
}

}  // namespace

template <int capacity>
DeltaSignal delta_signal(const SampledFilter<capacity>& filter, const StateOutputs<capacity>& outputs,
                         const SampleView& u, Hold hold, double delay, bool longer) {
    const int n = filter.states;
    const DelayedStep<capacity> step = delayed_step(filter, hold, delay);
    // x = after_next w[k+1] + g w[k] + T [X_0 .. X_(n-1)]
    const StateVector<capacity> g = sum(step.next, 1, moved(step.E, step.after_next, n));
    const StateVector<capacity> input = sum(step.now, 1, moved(step.E, g, n));
    const auto [alpha, T] = expansion_of(filter, step.E, input);
    DeltaSignal signal;
    DeltaChain& chain = signal.chain;
    chain.order = n;
    std::copy_n(alpha.at, n, chain.alpha.data());
    chain.samples = u.data();
    chain.count = u.size();
    chain.begin = step.begin;
    const StateVector<capacity> away = times(u[0], sum(step.first, -1, g));
    if (!away.is_zero()) {
        StateMatrix<capacity> columns;
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) columns(k, j) = T(j, k);
        std::copy_n(scaled_solution(columns, away, n).at, n, chain.start.data());
    }
    if (longer) {
        // w[k+1] of this chain, which has a pole at q = 0 more.
        double first = u[0];
        for (int j = 0; j < n; ++j) first -= alpha[j] * chain.start[static_cast<std::size_t>(j)];
        chain.start[static_cast<std::size_t>(n)] = first;
        chain.alpha[static_cast<std::size_t>(n)] = 1;
        for (int j = n; j > 0; --j)
            chain.alpha[static_cast<std::size_t>(j)] += chain.alpha[static_cast<std::size_t>(j - 1)];
        chain.order = n + 1;
        ++chain.samples;
        --chain.count;
    }
    signal.count = outputs.count;
    for (int i = 0; i < outputs.count; ++i) {
        const StateVector<capacity>& C = outputs.C[i];
        double* const output = signal.outputs[i];
        double of_w = (1 - step.weight_of_next) * outputs.D[i], of_next = step.weight_of_next * outputs.D[i];
        for (int k = 0; k < n; ++k) {
            if (C[k] == 0) continue;
            for (int j = 0; j < capacity; ++j) output[j] += C[k] * T.column[k][j];
            of_w += C[k] * g[k];
            of_next += C[k] * step.after_next[k];
        }
        // w = X_n + sum alpha_j X_j
        for (int j = 0; j < n; ++j) output[j] += of_w * alpha[j];
        output[n] += of_w;
        if (!longer) continue;
        for (int j = 0; j <= n; ++j) output[j] += of_next * chain.alpha[static_cast<std::size_t>(j)];
        output[n + 1] += of_next;
    }
    return signal;
}

template struct SampledFilter<4>;
template struct SampledFilter<8>;
template DeltaSignal delta_signal(const SampledFilter<4>&, const StateOutputs<4>&, const SampleView&, Hold, double,
                                  bool);
template DeltaSignal delta_signal(const SampledFilter<8>&, const StateOutputs<8>&, const SampleView&, Hold, double,
                                  bool);

}  // namespace dynlab::inline numerics
