#pragma once
#include <vector>

#include "numerics/filters/filtered_signal.h"
#include "numerics/filters/lanes.h"

namespace dynlab::inline numerics {

/// Runs a FilteredSignal in eight lanes. Samples first, ..., first + 8 segment - 1 are cut into eight equal segments,
/// which advance together, one lane each, a block of steps at a time; row `k` of a block is sample
/// first + lane segment + (steps so far) + k of each lane. The state at the beginning of each segment is found first:
/// each lane runs once over the end of the segment before its own, as far back as the system remembers (to rounding),
/// so that the lanes agree with the sample-by-sample recursion to rounding.
class LaneFilter {
  public:
    static constexpr Index kBlock = 32;  ///< most steps at a time

    /// `state` at sample `first`, which must come after the sample at which the delayed signal begins; sample
    /// first + 8 segment must exist.
    LaneFilter(const FilteredSignal& filtered, Index first, Index segment, const Vector& state);

    void advance(Index steps);
    /// Output j of the steps just made.
    const Lanes* column(Index output) const;
    /// State at sample first + 8 segment, after all steps are made.
    Vector last_state() const;

  private:
    using Step = void (LaneFilter::*)(Index steps, bool keep);
    template <int kOrder, bool kCascade, bool kNext, bool kPrevious>
    void step(Index steps, bool keep);
    void step_any(Index steps, bool keep);
    template <int kOrder, bool kCascade>
    static Step step_of(bool next, bool previous);
    static Step step_for(Index order, bool cascade, bool next, bool previous);

    struct Term {
        double weight;
        Index column;
    };
    struct Combination {
        Index column;
        std::vector<Term> terms;
    };
    void plan_outputs(const Matrix& C, const Matrix& D);
    void find_segment_states(const Vector& state);
    void combine_outputs(Index steps);
    template <std::size_t kCount>
    void add_terms(const Term* terms, Index steps, bool first, Lanes* sum) const;

    Index order_, segment_;
    bool sees_next_, sees_previous_, keeps_input_ = false;
    Matrix F_, G_;
    std::vector<Index> output_columns_;
    std::vector<Combination> combinations_;
    const double* signal_;  // at sample first - delay
    Step step_;
    std::vector<Lanes> state_, columns_;  // columns: the states, u[k-d], u[k-d-1], the combined outputs
    Index position_ = 0;
};

}  // namespace dynlab::inline numerics
