#pragma once
#include <array>
#include <cmath>

namespace dynlab::inline numerics {

/// State-variable filters 1/A and cascades B/A, 1/A whose coefficients may change at every sample: a step is exact for
/// a signal on a straight line (or held), by Taylor's series of the motion itself (Al-Mohy and Higham 2011), without
/// a matrix exponential. A state holds p^(n-1) v_f, ..., p v_f, v_f, which keep their meaning when A changes.
inline constexpr int kMaxEvolvingPoles = 8;

/// A = p^n + a_1 p^(n-1) + ... and B = b_0 p^m + ..., m <= n.
struct EvolvingModel {
    int n = 0, m = 0;
    std::array<double, kMaxEvolvingPoles> a{};
    std::array<double, kMaxEvolvingPoles + 1> b{};

    /// `theta` = [a_1..a_n b_0..b_m].
    void set(const double* theta) {
        for (int i = 0; i < n; ++i) a[static_cast<std::size_t>(i)] = theta[i];
        for (int i = 0; i <= m; ++i) b[static_cast<std::size_t>(i)] = theta[n + i];
    }
};

using EvolvingState = std::array<double, kMaxEvolvingPoles>;

/// The number of equal pieces in which a step h is gone so that the series converge quickly without cancellation:
/// sum_i |a_i| (h/pieces)^i <= 1. More than `max_pieces`: 0.
inline int pieces_of_step(const EvolvingModel& model, double h, int max_pieces = 1024) {
    for (int pieces = 1; pieces <= max_pieces; pieces *= 2) {
        double sum = 0, power = 1;
        for (int i = 0; i < model.n; ++i) sum += std::abs(model.a[static_cast<std::size_t>(i)]) * (power *= h / pieces);
        if (sum <= 1) return pieces;
    }
    return 0;
}

/// p^n v_f at a sample where the signal is v.
template <int kOrder>
double highest_derivative(const EvolvingModel& model, const EvolvingState& state, double v) {
    const int n = kOrder > 0 ? kOrder : model.n;
    for (int i = 0; i < n; ++i) v -= model.a[static_cast<std::size_t>(i)] * state[static_cast<std::size_t>(i)];
    return v;
}

/// B v_f at a sample where the signal is v.
template <int kOrder>
double filtered_numerator(const EvolvingModel& model, const EvolvingState& state, double v) {
    const int n = kOrder > 0 ? kOrder : model.n;
    double sum = 0;
    for (int j = 0; j <= model.m; ++j) {
        const int derivative = model.m - j;
        sum += model.b[static_cast<std::size_t>(j)] * (derivative == n
                                                           ? highest_derivative<kOrder>(model, state, v)
                                                           : state[static_cast<std::size_t>(n - 1 - derivative)]);
    }
    return sum;
}

namespace evolving {

inline constexpr double kNegligible = 1e-16;
inline constexpr int kMaxTerms = 40;

/// Adds a term of a series to a state; whether it still counts.
template <int kOrder>
bool add_term(int order, const EvolvingState& term, EvolvingState& state) {
    const int n = kOrder > 0 ? kOrder : order;
    bool counts = false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        state[i] += term[i];
        counts = counts || std::abs(term[i]) > kNegligible * std::abs(state[i]);
    }
    return counts;
}

/// The next term of the motion, `rate` = h/k times the derivative of the one before; `driven` enters the first state.
template <int kOrder>
EvolvingState next_term(const EvolvingModel& model, const EvolvingState& term, double driven, double rate) {
    const int n = kOrder > 0 ? kOrder : model.n;
    EvolvingState next;
    next[0] = rate * highest_derivative<kOrder>(model, term, driven);
    for (std::size_t i = 1; i < static_cast<std::size_t>(n); ++i) next[i] = rate * term[i - 1];
    return next;
}

}  // namespace evolving

/// One step h over which the signal runs straight from `from` to `to`.
template <int kOrder>
void advance_filter(const EvolvingModel& model, EvolvingState& state, double from, double to, double h) {
    EvolvingState term = evolving::next_term<kOrder>(model, state, from, h);
    evolving::add_term<kOrder>(model.n, term, state);
    term = evolving::next_term<kOrder>(model, term, to - from, h / 2);
    const int n = kOrder > 0 ? kOrder : model.n;
    for (int k = 3; (evolving::add_term<kOrder>(model.n, term, state) || k <= n + 1) && k < evolving::kMaxTerms; ++k)
        term = evolving::next_term<kOrder>(model, term, 0, h / k);
}

/// A signal that runs straight over a step.
struct StraightSignal {
    double from, to;
    /// What drives the k-th term of the series.
    double part(int k) const { return k == 1 ? from : k == 2 ? to - from : 0; }
};

/// The same of two signals through filters of the same model, y through the first one alone, v on into a second one
/// whose signal is B v_f: its state becomes p^i B/A^2 v. Three series side by side take little longer than one.
template <int kOrder>
void advance_cascade(const EvolvingModel& model, EvolvingState& alone, StraightSignal y, EvolvingState& first,
                     EvolvingState& second, StraightSignal v, double h) {
    EvolvingState other = alone, term = first, behind = second;
    const int n = kOrder > 0 ? kOrder : model.n;
    bool counts = true;
    for (int k = 1; (counts || k <= 2 * n + 2) && k < evolving::kMaxTerms; ++k) {
        const double rate = h / k;
        behind = evolving::next_term<kOrder>(model, behind, filtered_numerator<kOrder>(model, term, v.part(k)), rate);
        term = evolving::next_term<kOrder>(model, term, v.part(k), rate);
        other = evolving::next_term<kOrder>(model, other, y.part(k), rate);
        const bool of_first = evolving::add_term<kOrder>(model.n, term, first),
                   of_second = evolving::add_term<kOrder>(model.n, behind, second),
                   of_other = evolving::add_term<kOrder>(model.n, other, alone);
        counts = of_first || of_second || of_other;
    }
}

}  // namespace dynlab::inline numerics
