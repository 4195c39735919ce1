#pragma once
#include <array>

#include "numerics/simulation/companion_pair.h"

namespace dynlab::inline numerics {

/// How a step of length h acts on a companion system or a pair of them (companion_pair.h), as power series in h. Each
/// state but the first is the integral of the one before, so that rows of exp(A h), and what constant inputs and ramps
/// of one a second make of the states, follow from the rows below them: series of the last row are enough, and of every
/// second with many states, where rounding errors would grow from row to row. All that is without the identity in
/// exp(A h), beside which short steps would lose their digits. States are scaled so that A is balanced.
struct CompanionSeries {
    explicit CompanionSeries(const CompanionPair& pair);

    bool twice = false;
    Index order = 0;  ///< n, of one system
    Vector scale;     ///< of all states: x = scale * what is computed with; 1 for the first, powers of two
    /// The rows of series, the last one first, are `gap` apart.
    static constexpr Index kMaxStatesOfOneRow = 5;  // states
    Index gap = 1;
    /// Column k: the coefficients of h^k; for each such row those of exp(A h) - I's row, of its constant input, and
    /// with a second system of its share of the first and constant input; behind them the ramps of all, then zeros.
    Matrix terms;
    static constexpr Index kTogether = 4, kLastTerm = 20;  // the rows of `terms` are a multiple of kTogether
    /// Steps up to reach[k] (s) need the terms up to the k-th: what is left out is 4e-17 of the state.
    std::array<double, kLastTerm + 1> reach = {};
    /// Entry j of row i - 1 of exp(A h) - I: first(i - 1, j) times entry 0 of row i and next(i - 1, j) times entry j
    /// + 1.
    Matrix first, next;
    Vector integral;    ///< of the slope of state i, which is state i - 1
    Index driving = 0;  ///< the state of the first system that drives the second
    Vector drive;  ///< row i - 1 of the second's share: more in that column for each of entry 0 of exp(A h)'s row i

  private:
    void set_terms(const Matrix& balanced);
};

/// How steps up to some length are made: from a part of each, by the series up to a term, doubled so many times. What
/// is left out is 4e-17 of the state.
struct StepPlan {
    double part = 1;
    int doublings = 0;
    Index last_term = 0;

    StepPlan(const CompanionSeries& series, double max_step);
};

}  // namespace dynlab::inline numerics
