#pragma once
#include <algorithm>
#include <array>

#include "numerics/filters/lane_cascade.h"

namespace dynlab::inline numerics {

/// How a cascade's state moves by itself over a segment of so many samples.
template <int kOrder>
class SegmentMemory {
  public:
    using State = Eigen::Matrix<double, kOrder, 1>;
    using Transition = Eigen::Matrix<double, kOrder, kOrder>;

    SegmentMemory(const CascadeSource& source, Index segment) {
        if constexpr (kOrder > 0) measure(source, segment);
    }

    /// Samples before a lane's first one that its state remembers, or all of a segment.
    Index back() const { return back_; }
    /// After a run from rest over the end of the segments, each lane's last state is where the next one begins.
    template <class Shape>
    void hand_over(const Eigen::Vector4d& start, CascadeRun<Shape, Lanes::Part>& run) const {
        State x = start.head<kOrder>();
        for (int lane = 0; lane < kCascadeLanes; ++lane) {
            State next;
            for (int i = 0; i < kOrder; ++i) {
                next[i] = run.state(i)[lane];
                run.state(i)[lane] = x[i];
            }
            x = (next + through_.lazyProduct(x)).eval();
        }
    }

  private:
    void measure(const CascadeSource& source, Index segment) {
        constexpr double kStateDecay = 1e-19;  // what is left of a state after so many steps is less than rounding
        Transition power = transition(source);
        through_.setIdentity();
        Index reached = 1;  // `power` is the transition over so many steps, `through_` that over `segment` modulo these
        for (; reached < segment && power.cwiseAbs().maxCoeff() > kStateDecay; reached *= 2) {
            if (segment & reached) through_ = power.lazyProduct(through_).eval();
            power = power.lazyProduct(power).eval();
        }
        back_ = std::min(reached, segment);
        if (back_ < segment)
            through_.setZero();
        else if (reached == segment)
            through_ = power;
    }

    static Transition transition(const CascadeSource& source) {
        Transition F = Transition::Zero();
        for (int i = 0; i < kOrder; ++i) {
            const PolePair& pair = source.pairs[static_cast<std::size_t>(i / 2)];
            F(i, i) = pair.centre;
            if (i > 0) F(i, i - 1) = 1;
            if (i % 2 == 1) F(i - 1, i) = pair.square;
        }
        return F;
    }

    Transition through_;
    Index back_ = 0;
};

/// The states of all lanes at their first samples, from those of the sources at the first sample of the first lane.
/// Each lane runs over the end of the segment before its own, both signals at once: alone, each would wait for itself.
template <class First, class Second>
[[gnu::always_inline]] inline void find_states(CascadeRun<First, Lanes::Part>& first,
                                               CascadeRun<Second, Lanes::Part>& second,
                                               const std::array<CascadeSource, 2>& sources, Index segment) {
    const SegmentMemory<First::kOrder> of_first(sources[0], segment);
    const SegmentMemory<Second::kOrder> of_second(sources[1], segment);
    const Index both = segment - std::min(of_first.back(), of_second.back());
    for_samples<true>(
        first, second, segment - of_first.back(),
        both, [&](const auto& v, const auto&) __attribute__((always_inline)) { first.step(v); });
    for_samples<true>(
        first, second, segment - of_second.back(),
        both, [&](const auto&, const auto& w) __attribute__((always_inline)) { second.step(w); });
    for_samples<true>(
        first, second, both, segment, [&](const auto& v, const auto& w) __attribute__((always_inline)) {
            first.step(v);
            second.step(w);
        });
    of_first.hand_over(sources[0].state, first);
    of_second.hand_over(sources[1].state, second);
}

}  // namespace dynlab::inline numerics
