#pragma once
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "numerics/filters/delta_chain.h"
#include "numerics/filters/tapped_system.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/short_step.h"

namespace dynlab::inline numerics {

// Continuous-time systems as delta chains, exactly for held inputs (zoh) and inputs on straight lines (foh), with any
// delay; the number of states is known to the compiler, so that sampling does not take longer than a short record.

template <int n>
using StateMatrix = Eigen::Matrix<double, n, n>;
template <int n>
using StateVector = Eigen::Matrix<double, n, 1>;

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

template <int n>
SizedStep<n, 1> step_of(const StateMatrix<n>& A, double h) {
    const StateVector<n> input = StateVector<n>::Unit(0);
    if (const auto step = short_step<n, 1>(A, input, h)) return *step;
    const StepMatrices step = exact_step(A, input, h);
    return {step.F, step.G, step.H0, step.H1, step.F - Matrix::Identity(n, n)};
}

template <int n>
DelayedStep<n> delayed_step(const StateMatrix<n>& A, double Ts, Hold hold, double delay) {
    const auto [samples, rest] = split_delay(delay, Ts);
    const bool held = hold == Hold::kZoh;
    const SizedStep<n, 1> second = step_of<n>(A, Ts - rest);
    DelayedStep<n> step;
    step.begin = samples;
    step.after_next.setZero();
    step.first.setZero();
    if (rest == 0) {
        step.E = second.E;
        step.next.setZero();
        if (!held) step.next = second.H1;
        step.now = held ? second.G : second.H0;
        return step;
    }
    // In the first `late` of the interval, u runs from w[k] towards w[k+1], then on towards w[k+2].
    const double late = rest / Ts;
    const SizedStep<n, 1> first = step_of<n>(A, rest);
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

/// DeltaChain::alpha of det(delta I - E), by sums of principal minors: those of slow poles keep their digits beside
/// fast ones.
template <int n>
StateVector<n> delta_polynomial(const StateMatrix<n>& E) {
    StateVector<n> alpha;
    if constexpr (n == 1) {
        alpha << -E(0, 0);
    } else if constexpr (n == 2) {
        alpha << E.determinant(), -E.trace();
    } else {
        static_assert(n == 3 || n == 4);
        const auto minor = [&](int i, int j) { return E(i, i) * E(j, j) - E(i, j) * E(j, i); };
        double pairs = 0;
        for (int i = 0; i < n; ++i)
            for (int j = i + 1; j < n; ++j) pairs += minor(i, j);
        alpha[n - 1] = -E.trace();
        alpha[n - 2] = pairs;
        if constexpr (n == 3) {
            alpha[0] = -E.determinant();
        } else {
            double triples = 0;
            for (int left_out = 0; left_out < n; ++left_out) {
                Eigen::Matrix3d block;
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j) block(i, j) = E(i + (i >= left_out), j + (j >= left_out));
                triples += block.determinant();
            }
            alpha[1] = -triples;
            alpha[0] = E.determinant();
        }
    }
    return alpha;
}

/// alpha of the product of two such polynomials.
template <int n, int m>
StateVector<n + m> delta_product(const StateVector<n>& a, const StateVector<m>& b) {
    StateVector<n + m> product = StateVector<n + m>::Zero();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) product[i + j] += a[i] * b[j];
    product.template tail<m>() += b;
    for (int i = 0; i < n; ++i) product[m + i] += a[i];
    return product;
}

/// (delta I - E)^-1 = sum_j M_j delta^j/A (Faddeev).
template <int n>
std::array<StateMatrix<n>, n> resolvent(const StateMatrix<n>& E, const StateVector<n>& alpha) {
    std::array<StateMatrix<n>, n> M;
    M[n - 1].setIdentity();
    for (std::size_t j = n - 1; j > 0; --j)
        M[j - 1] = E.lazyProduct(M[j]) + alpha[static_cast<Index>(j)] * StateMatrix<n>::Identity();
    return M;
}

/// Sampled states as combinations of a chain's columns: (delta I - E)^-1 input = sum_j states.col(j) delta^j/A.
template <int n>
struct StateExpansion {
    StateVector<n> alpha;
    StateMatrix<n> states;
};
template <int n>
StateExpansion<n> expansion(const StateMatrix<n>& E, const StateVector<n>& input) {
    StateExpansion<n> x{delta_polynomial<n>(E), {}};
    const auto M = resolvent<n>(E, x.alpha);
    for (int j = 0; j < n; ++j) x.states.col(j) = M[static_cast<std::size_t>(j)].lazyProduct(input);
    return x;
}
/// For the cascade of two equal systems of n states each. Block by block, poles that are far apart cost no digits
/// twice.
template <int n>
StateExpansion<2 * n> cascade_expansion(const StateMatrix<2 * n>& E, const StateVector<2 * n>& input) {
    const StateMatrix<n> own = E.template topLeftCorner<n, n>(), between = E.template bottomLeftCorner<n, n>();
    const StateVector<n> alpha = delta_polynomial<n>(own);
    const auto M = resolvent<n>(own, alpha);
    StateExpansion<2 * n> x{delta_product<n, n>(alpha, alpha), StateMatrix<2 * n>::Zero()};
    for (int j = 0; j < n; ++j) {
        const StateMatrix<n>& Mj = M[static_cast<std::size_t>(j)];
        const StateVector<n> first = Mj.lazyProduct(input.template head<n>());
        const StateVector<n> second = Mj.lazyProduct(input.template tail<n>()), drive = between.lazyProduct(first);
        for (int i = 0; i <= n; ++i) {
            const double weight = i < n ? alpha[i] : 1;
            if (i + j < 2 * n) {
                x.states.col(i + j).template head<n>() += weight * first;
                x.states.col(i + j).template tail<n>() += weight * second;
            }
            if (i < n) x.states.col(i + j).template tail<n>() += M[static_cast<std::size_t>(i)].lazyProduct(drive);
        }
    }
    return x;
}

/// A signal's chain, and outputs as combinations of its columns.
struct DeltaSignal {
    DeltaChain chain;
    ColumnMatrix outputs;
};

/// x of T x = b, where rows and columns of T may differ in size by many orders of magnitude.
template <int n>
StateVector<n> scaled_solution(StateMatrix<n> T, StateVector<n> b) {
    const auto inverse = [](double norm) { return norm > 0 ? 1 / norm : 1; };
    const StateVector<n> rows = T.rowwise().norm().unaryExpr(inverse);
    T = (rows.asDiagonal() * T).eval();
    const StateVector<n> columns = T.colwise().norm().transpose().unaryExpr(inverse);
    T = (T * columns.asDiagonal()).eval();
    return columns.cwiseProduct(T.partialPivLu().solve(rows.cwiseProduct(b)));
}

/// y = C x + D u for the system of `step`, `expand` being one of the expansions above. `longer`: as a chain of n + 1
/// columns, which inputs on straight lines with a delay between samples need.
template <int n, class Outputs, class Expand>
DeltaSignal delta_signal(const DelayedStep<n>& step, const Expand& expand, const Outputs& C, const Vector& D,
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
