#pragma once
#include <array>
#include <type_traits>

#include "numerics/filters/lanes.h"
#include "numerics/filters/newton_basis.h"

namespace dynlab::inline numerics {

// Cascades in the Newton basis (newton_basis.h) step by step, segments of the record side by side in the lanes of
// machine vectors; all sizes are known to the compiler, and nothing is allocated.

constexpr int kCascadeLanes = Lanes::kWidth;
constexpr Index kShortestCascadeSegment = 8;  ///< samples a lane; shorter ones are not worth it

/// A signal as its cascade sees it.
struct CascadeSource {
    std::array<PolePair, 2> pairs = {};
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
    /// samples[j] = sample(k + j) for as many samples as there are lanes, which takes fewer loads.
    [[gnu::always_inline]] void samples(Index k, Number* samples) const {
        if constexpr (Shape::kColumns > 0) Lanes::gather_tile(v_ + k, segment_, samples);
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
        repeat<kPairs>([&](auto i) __attribute__((always_inline)) {
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

/// f(v, w) for the samples from .. to - 1 of the two runs. kTiles: several are loaded at once, which takes registers
/// that f must not need.
template <bool kTiles, class First, class Second, class Number, class Function>
[[gnu::always_inline]] inline void for_samples(const CascadeRun<First, Number>& first,
                                               const CascadeRun<Second, Number>& second, Index from, Index to,
                                               const Function& f) {
    Index k = from;
    if constexpr (kTiles && std::is_same_v<Number, Lanes::Part>)
        for (; k + kCascadeLanes <= to; k += kCascadeLanes) {
            first.fetch_ahead(k);
            second.fetch_ahead(k);
            Number v[kCascadeLanes] = {}, w[kCascadeLanes] = {};
            first.samples(k, v);
            second.samples(k, w);
            for (int j = 0; j < kCascadeLanes; ++j) f(v[j], w[j]);
        }
    for (; k < to; ++k) {
        if constexpr (!kTiles) {
            first.fetch_ahead(k);
            second.fetch_ahead(k);
        }
        f(first.sample(k), second.sample(k));
    }
}

}  // namespace dynlab::inline numerics
