#pragma once
#include <algorithm>
#include <array>
#include <type_traits>

#include "numerics/kernels/cascade_basis.h"
#include "numerics/kernels/lanes.h"

namespace dynlab {

// Cascades (cascade_basis.h) step by step, segments of the record side by side in the lanes of machine vectors; all
// sizes are known to the compiler, and nothing is allocated.

constexpr int kCascadeLanes = Lanes::kWidth;
constexpr Index kShortestCascadeSegment = 8;  ///< samples a lane; shorter ones are not worth it

/// A signal as its cascade sees it.
struct CascadeSource {
    std::array<CascadeBasis::Pair, 2> pairs = {};
    double feed = 0;                                  ///< where only q is a column
    const double* v = nullptr;                        ///< the first sample of the sums
    Eigen::Vector4d state = Eigen::Vector4d::Zero();  ///< there; as many as the cascade has
};

/// What the columns of a cascade are: its states, or, kFed, for two poles and one output, q alone, which
/// q[k+1] = centre q[k] + p[k] + feed v[k] makes a multiple of the output; kTap: after them the sample. kRepeated: the
/// two poles are one, `square` is zero.
template <int kOrder_, bool kFed_, bool kTap_, bool kRepeated_ = false>
struct CascadeShape {
    static constexpr int kOrder = kOrder_;
    static constexpr bool kFed = kFed_;
    static constexpr bool kTap = kTap_;
    static constexpr bool kRepeated = kRepeated_;
    static constexpr int kColumns = (kFed ? 1 : kOrder) + (kTap ? 1 : 0);
};
using NoCascade = CascadeShape<0, false, false>;

/// The states of one signal step by step, in all lanes (Number = Lanes::Part) or in one (double).
template <class Shape, class Number>
class CascadeRun {
  public:
    static constexpr int kOrder = Shape::kOrder;

    /// At the sample `first` of the source, segments being `segment` samples apart.
    CascadeRun(const CascadeSource& source, Index first, Index segment)
        : v_(source.v + first), segment_(segment), feed_(Number{} + source.feed) {
        for (int i = 0; i < kPairs; ++i) {
            centre_[i] = Number{} + source.pairs[static_cast<std::size_t>(i)].centre;
            square_[i] = Number{} + source.pairs[static_cast<std::size_t>(i)].square;
        }
    }

    [[gnu::always_inline]] Number sample(Index k) const {
        if constexpr (Shape::kColumns == 0)
            return Number{};
        else if constexpr (std::is_same_v<Number, double>)
            return v_[k];
        else
            return Lanes::gather_part(v_ + k, segment_);
    }
    /// Asks the memory for what is needed soon: by itself, the processor stops at the end of every page.
    [[gnu::always_inline]] void fetch_ahead(Index k) const {
        constexpr Index kLine = 8, kAhead = 16 * kLine;  // samples
        if (Shape::kColumns == 0 || k % kLine != 0 || k + kAhead >= segment_) return;
        for (int lane = 0; lane < kCascadeLanes; ++lane) __builtin_prefetch(v_ + k + kAhead + lane * segment_);
    }
    [[gnu::always_inline]] Number column(int i, const Number& v) const {
        if constexpr (Shape::kFed) return i == 0 ? state_[1] : v;
        if constexpr (kOrder == 0) return v;
        return i < kOrder ? state_[i] : v;
    }
    [[gnu::always_inline]] void step(const Number& v) {
        // From the last pair to the first: each is driven by what the one before has been.
        repeat<kPairs>([&](auto i) {
            constexpr int b = kPairs - 1 - i;
            Number drive = v;
            if constexpr (b > 0) drive = state_[2 * b - 1];
            if constexpr (2 * b + 1 < kOrder) {
                const Number p = state_[2 * b], q = state_[2 * b + 1];
                Number own = p;
                if constexpr (Shape::kFed) own += feed_ * v;
                state_[2 * b + 1] = centre_[b] * q + own;
                if constexpr (!Shape::kRepeated) drive += square_[b] * q;
            }
            state_[2 * b] = centre_[b] * state_[2 * b] + drive;
        });
    }

    const Number& state(int i) const { return state_[i]; }
    Number& state(int i) { return state_[i]; }

  private:
    static constexpr int kPairs = (kOrder + 1) / 2;

    const double* v_;
    Index segment_;
    Number feed_, centre_[kPairs + 1], square_[kPairs + 1], state_[kOrder + 1] = {};  // an array of none is not allowed
};

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
            x = next + through_.lazyProduct(x);
        }
    }

  private:
    void measure(const CascadeSource& source, Index segment) {
        constexpr double kForgotten = 1e-19;  // what is left of a state after so many steps is less than rounding
        Transition power = transition(source);
        through_.setIdentity();
        Index reached = 1;  // `power` is the transition over so many steps, `through_` that over `segment` modulo these
        for (; reached < segment && power.cwiseAbs().maxCoeff() > kForgotten; reached *= 2) {
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
            const CascadeBasis::Pair& pair = source.pairs[static_cast<std::size_t>(i / 2)];
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
    for (Index k = segment - of_first.back(); k < both; ++k) first.step(first.sample(k));
    for (Index k = segment - of_second.back(); k < both; ++k) second.step(second.sample(k));
    for (Index k = both; k < segment; ++k) {
        first.step(first.sample(k));
        second.step(second.sample(k));
    }
    of_first.hand_over(sources[0].state, first);
    of_second.hand_over(sources[1].state, second);
}

}  // namespace dynlab
