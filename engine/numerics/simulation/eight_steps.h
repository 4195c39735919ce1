#pragma once
#include <algorithm>
#include <vector>

#include "numerics/simulation/step_map.h"

namespace dynlab::inline numerics {

/// The maps of eight steps, side by side. Long steps are halved before and doubled behind.
template <int kOrder, bool kTwice>
class EightSteps : public StepMap<kOrder, kTwice> {
    using Map = StepMap<kOrder, kTwice>;

  public:
    using Map::order, Map::states, Map::kStates;
    using States = Eigen::Array<double, kSideBySide, kStates>;

    EightSteps(const CompanionSeries& series, bool ramps)
        : Map(series, ramps), series_(series), ramps_(ramps), plan_(series, 0), doubled_(this->own().size()) {}

    /// The next steps are none longer than this (s).
    void prepare(double max_step) { plan_ = StepPlan(series_, max_step); }

    /// For steps of `length` (s).
    void set(const Eight& length, Eight* map) {
        Eight part = length * plan_.part;
        sum_series(part, plan_.last_term, map);
        fill(map);
        for (int i = 0; i < plan_.doublings; ++i, part *= 2) {
            double_rows(part, map);
            fill(map);
        }
    }

    /// The states behind the steps.
    [[gnu::always_inline]] void advance(const Eight* map, const Eight& u, const Eight& slope, States& x) const {
        const Index n = order();
        const auto times = [&](Index row, Index state, Eight sum) __attribute__((always_inline)) {
            for (Index j = 0; j < n; ++j) sum += map[row + j] * x.col(state + j);
            return sum;
        };
        States next(kSideBySide, states());
        for (Index i = 0; i < n; ++i) {
            Eight sum = x.col(i) + map[place_of_G() + i] * u;
            if (ramps_) sum += map[place_of_R() + i] * slope;
            next.col(i) = times(i * n, 0, sum);
        }
        for (Index i = 0; kTwice && i < n; ++i) {
            Eight sum = x.col(n + i) + map[place_of_H() + i] * u;
            if (ramps_) sum += map[place_of_S() + i] * slope;
            next.col(n + i) = times(i * n, n, times(place_of_L() + i * n, 0, sum));
        }
        for (Index i = 0; i < states(); ++i) x.col(i) = next.col(i);
    }

    /// Where stretches begin that follow each other, of which these are the maps and `from_rest` what inputs make of
    /// each: the first at begin's first row, which is given.
    void chain(const Eight* map, const States& from_rest, States& begin) const {
        const Index n = order();
        for (Index lane = 0; lane + 1 < kSideBySide; ++lane)
            for (Index i = 0; i < n; ++i) {
                double sum = from_rest(lane, i) + begin(lane, i), second = 0;
                if (kTwice) second = from_rest(lane, n + i) + begin(lane, n + i);
                for (Index j = 0; j < n; ++j) {
                    const double E = map[i * n + j][lane];
                    sum += E * begin(lane, j);
                    if (kTwice) second += map[place_of_L() + i * n + j][lane] * begin(lane, j) + E * begin(lane, n + j);
                }
                begin(lane + 1, i) = sum;
                if (kTwice) begin(lane + 1, n + i) = second;
            }
    }

  private:
    using Map::gap, Map::own, Map::without_ramps;
    using Map::place_of_G, Map::place_of_L, Map::place_of_H, Map::place_of_R, Map::place_of_S;
    static constexpr Index kRamps = kTwice ? 2 : 1;  // of a row
    static constexpr Index kTogether = kOrder == Eigen::Dynamic ? CompanionSeries::kTogether : kRamps * (kOrder + 1);

    [[gnu::always_inline]] void sum_series(const Eight& length, Index last, Eight* map) const {
        const auto all = static_cast<Index>(own().size());
        for (Index row = 0; row < without_ramps(); row += kTogether) sum_together<kTogether>(row, length, last, map);
        for (Index row = without_ramps(); row < all; row += kRamps) sum_together<kRamps>(row, length, last, map);
    }
    template <Index kCount>
    [[gnu::always_inline]] void sum_together(Index row, const Eight& length, Index last, Eight* map) const {
        const Index stride = series_.terms.rows();
        const double* term = series_.terms.data() + row + last * stride;
        Eight sums[kCount];
        for (Index i = 0; i < kCount; ++i) sums[i].setZero();
        for (Index k = last; k >= 0; --k, term -= stride)
            for (Index i = 0; i < kCount; ++i) sums[i] = sums[i] * length + term[i];
        const Index left = static_cast<Index>(own().size()) - row;
        for (Index i = 0; i < (kOrder == Eigen::Dynamic ? std::min(kCount, left) : kCount); ++i)
            map[own()[static_cast<std::size_t>(row + i)]] = sums[i];
    }

    /// The rows in between.
    [[gnu::always_inline]] void fill(Eight* map) const {
        const Index n = order();
        Eight *const G = map + place_of_G(), *const L = map + place_of_L(), *const H = map + place_of_H();
        for (Index i = n - 1; i > 0; --i) {
            if ((n - i) % gap() == 0) continue;  // the row above has its own series
            const double integral = series_.integral[i - 1];
            fill_row(map + i * n, i - 1);
            G[i - 1] = integral * map[i * n];
            if (kTwice) {
                fill_row(L + i * n, i - 1);
                L[(i - 1) * n + series_.driving] += series_.drive[i - 1] * map[i * n];
                H[i - 1] = integral * L[i * n];
            }
            if (ramps_) map[place_of_R() + i - 1] = integral * G[i];
            if (ramps_ && kTwice) map[place_of_S() + i - 1] = integral * H[i];
        }
    }
    /// The row above this one, row `above`, without what drives it.
    [[gnu::always_inline]] void fill_row(Eight* row, Index above) const {
        const Index n = order();
        for (Index j = 0; j < n; ++j) {
            row[j - n] = series_.first(above, j) * row[0];
            if (j + 1 < n) row[j - n] += series_.next(above, j) * row[j + 1];
        }
    }

    /// The rows of series for twice the `length` of the map.
    [[gnu::always_inline]] void double_rows(const Eight& length, Eight* map) {
        const Index n = order();
        const Eight *const E = map, *const G = map + place_of_G(), *const L = map + place_of_L(),
                           *const H = map + place_of_H(), *const R = map + place_of_R(), *const S = map + place_of_S();
        const auto times = [&](const Eight* row, const Eight* column, Index stride, Eight sum)
            __attribute__((always_inline)) {
            for (Index i = 0; i < n; ++i) sum += row[i] * column[i * stride];
            return sum;
        };
        Eight* doubled = doubled_.data();
        for (Index i = n - 1; i >= 0; i -= gap()) {
            const Eight *const row = E + i * n, *const share = L + i * n;
            for (Index j = 0; j < n; ++j) *doubled++ = times(row, E + j, n, 2 * row[j]);
            *doubled++ = times(row, G, 1, 2 * G[i]);
            if (!kTwice) continue;
            for (Index j = 0; j < n; ++j) *doubled++ = times(share, E + j, n, times(row, L + j, n, 2 * share[j]));
            *doubled++ = times(share, G, 1, times(row, H, 1, 2 * H[i]));
        }
        for (Index i = n - 1; ramps_ && i >= 0; i -= gap()) {
            const Eight *const row = E + i * n, *const share = L + i * n;
            *doubled++ = times(row, R, 1, 2 * R[i] + length * G[i]);
            if (kTwice) *doubled++ = times(share, R, 1, times(row, S, 1, 2 * S[i] + length * H[i]));
        }
        for (std::size_t i = 0; i < own().size(); ++i) map[own()[i]] = doubled_[i];
    }

    const CompanionSeries& series_;
    bool ramps_;
    StepPlan plan_;
    std::vector<Eight> doubled_;
};

}  // namespace dynlab::inline numerics
