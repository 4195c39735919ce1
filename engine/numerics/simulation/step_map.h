#pragma once
#include <vector>

#include "numerics/simulation/companion_series.h"
#include "numerics/simulation/irregular_events.h"

namespace dynlab::inline numerics {

constexpr Index kSideBySide = IrregularEvents::kSideBySide;
using Eight = Eigen::Array<double, kSideBySide, 1>;

/// Positions of the parts of a map, of a companion system of kOrder states x, and (kTwice) of a second one w behind it,
/// for an input that begins at u and has slope s (1/s):
///     x -> x + E x + G u + R s,   w -> w + L x + E w + H u + S s.
/// A map is the entries of E (row by row), G, L, H, R, S.
template <int kOrder, bool kTwice>
class StepMap {
  public:
    static constexpr int kStates = kOrder == Eigen::Dynamic ? Eigen::Dynamic : (kTwice ? 2 : 1) * kOrder;

    StepMap(const CompanionSeries& series, bool ramps) : order_(series.order), gap_(series.gap) {
        const Index n = order();
        const auto add_row = [&](Index row, Index input) {
            for (Index j = 0; j < n; ++j) own_.push_back(row + j);
            own_.push_back(input);
        };
        for (Index i = n - 1; i >= 0; i -= gap()) {
            add_row(i * n, place_of_G() + i);
            if (kTwice) add_row(place_of_L() + i * n, place_of_H() + i);
        }
        without_ramps_ = static_cast<Index>(own_.size());
        for (Index i = n - 1; ramps && i >= 0; i -= gap()) {
            own_.push_back(place_of_R() + i);
            if (kTwice) own_.push_back(place_of_S() + i);
        }
    }

    Index gap() const { return kOrder == Eigen::Dynamic ? gap_ : kOrder; }
    Index order() const { return kOrder == Eigen::Dynamic ? order_ : kOrder; }
    Index place_of_G() const { return order() * order(); }
    Index place_of_L() const { return place_of_G() + order(); }
    Index place_of_H() const { return place_of_L() + (kTwice ? order() * order() : 0); }
    Index place_of_R() const { return place_of_H() + (kTwice ? order() : 0); }
    Index place_of_S() const { return place_of_R() + order(); }
    Index states() const { return kStates == Eigen::Dynamic ? (kTwice ? 2 : 1) * order() : kStates; }
    Index entries() const { return place_of_S() + order(); }

    /// Places of what has its own series, in their order, and how many of them come before the ramps.
    const std::vector<Index>& own() const { return own_; }
    Index without_ramps() const { return without_ramps_; }

  private:
    Index order_, gap_, without_ramps_ = 0;
    std::vector<Index> own_;
};

}  // namespace dynlab::inline numerics
