#include "numerics/filters/delta_products.h"

#include <algorithm>

#include "numerics/filters/delta_loops.h"

namespace dynlab::inline numerics {

namespace {

using Part = Lanes::Part;
constexpr Index kMinDeltaSegmentLength = 8;  // samples a lane; shorter ones are not worth it
constexpr Index kDeltaBlock = 64;            // samples a lane that are copied at a time

/// How the states of two chains move by themselves over a segment, found by filtering nothing from unit states, one in
/// each lane: powers of matrices or polynomials would lose what slow poles leave beside fast ones.
class FreeMotion {
  public:
    FreeMotion(const DeltaChain& first, const DeltaChain& second, const DeltaLoops& loops, Index segment)
        : first_(first), second_(second), loops_(loops), segment_(segment), back_(segment) {
        constexpr Index kShort = 2048;  // looking is no gain for segments as short as this
        if (segment > kShort) back_ = std::max(memory_length(first, segment), memory_length(second, segment));
        set_units(0);
        for (int i = 1; i < kParts && back_ == segment && i * kDeltaLanes < std::max(first.order, second.order); ++i) {
            set_units(i);
            move(columns_[i]);
        }
    }

    /// Samples before a lane's first one that its state remembers, or all of a segment.
    Index back() const { return back_; }
    /// The first unit states, which the signals' own run takes along.
    DeltaState& first_units() { return columns_[0]; }
    /// After a run from rest over the end of the segments, each lane's last state is where the next one begins.
    void hand_over(DeltaState& state) const {
        repeat<kMaxDeltaOrder>([&](auto i) {
            if (first_.order == i + 1) hand_over<i + 1>(&DeltaState::first, state.first);
            if (second_.order == i + 1) hand_over<i + 1>(&DeltaState::second, state.second);
        });
    }

  private:
    static constexpr int kParts = (kMaxDeltaOrder + kDeltaLanes - 1) / kDeltaLanes;

    void set_units(int part) {
        DeltaState& state = columns_[part];
        state.set_zero(first_.order, second_.order);
        for (int lane = 0; lane < kDeltaLanes; ++lane) {
            const int unit = part * kDeltaLanes + lane;
            if (unit < first_.order) state.first[unit][lane] = 1;
            if (unit < second_.order) state.second[unit][lane] = 1;
        }
    }
    void move(DeltaState& free) const {
        const double zeros[kDeltaLanes + kDeltaBlock] = {};
        const SegmentSamples nothing{zeros + kDeltaLanes, 0};
        DeltaState rest;
        rest.set_zero(first_.order, second_.order);
        for (Index k = 0; k < segment_; k += kDeltaBlock)
            loops_.filter(first_, second_, nothing, nothing, std::min(segment_ - k, kDeltaBlock), rest, free);
    }
    template <int n>
    void hand_over(Part (DeltaState::*own)[kMaxDeltaOrder], Part* state) const {
        double motion[n][n] = {}, x[n] = {};
        if (back_ == segment_)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) motion[i][j] = (columns_[i / kDeltaLanes].*own)[j][i % kDeltaLanes];
        for (int lane = 0; lane < kDeltaLanes; ++lane) {
            double next[n];
            for (int j = 0; j < n; ++j) next[j] = state[j][lane];
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) next[j] += motion[i][j] * x[i];
            for (int j = 0; j < n; ++j) {
                state[j][lane] = x[j];
                x[j] = next[j];
            }
        }
    }

    const DeltaChain &first_, &second_;
    const DeltaLoops& loops_;
    Index segment_, back_;
    DeltaState columns_[kParts];
};

double total(const Part& part) {
    double sums[kDeltaLanes];
    for (int lane = 0; lane < kDeltaLanes; ++lane) sums[lane] = part[lane];
    for (int half = kDeltaLanes / 2; half > 0; half /= 2)
        for (int lane = 0; lane < half; ++lane) sums[lane] += sums[lane + half];
    return sums[0];
}

/// The samples of one chain in segments: the original samples, or a copy if not all lanes use the signal.
class SegmentReader {
  public:
    SegmentReader(const DeltaChain& chain, Index segment) : chain_(chain), segment_(segment) {}

    /// Of the steps from .. from + count - 1 of all segments, how many are read at once, beginning with the first.
    Index steps_at_once(Index from, Index count) const {
        const Index first = chain_.begin, last = chain_.begin + chain_.count - (kDeltaLanes - 1) * segment_;
        if (from >= first && from + kDeltaLanes <= last && count >= kDeltaLanes) return std::min(count, last - from);
        if (from < first) count = std::min(count, first - from);
        return std::min(count, kDeltaBlock);
    }
    /// No more steps than at once.
    SegmentSamples read(Index from, Index count) {
        const Index place = from - chain_.begin;
        if (place >= 0 && count >= kDeltaLanes && place + count + (kDeltaLanes - 1) * segment_ <= chain_.count)
            return {chain_.samples + place, segment_};
        for (int lane = 0; lane < kDeltaLanes; ++lane) copy(from + lane * segment_, count, lane);
        return {copied_[0] + kDeltaLanes, kCopied};
    }
    /// The same for one range of samples; the other lanes are zero.
    SegmentSamples read_one_lane(Index from, Index count) {
        for (int lane = 0; lane < kDeltaLanes; ++lane) copy(lane == 0 ? from : chain_.begin - count, count, lane);
        return {copied_[0] + kDeltaLanes, kCopied};
    }

  private:
    static constexpr Index kCopied = kDeltaLanes + kDeltaBlock;  // with as many samples before as a tile has

    void copy(Index from, Index count, int lane) {
        double* const to = copied_[lane];
        std::fill_n(to, kDeltaLanes, 0);
        for (Index k = 0; k < count; ++k) {
            const Index place = from + k - chain_.begin;
            to[kDeltaLanes + k] = place >= 0 && place < chain_.count ? chain_.samples[place] : 0;
        }
    }

    const DeltaChain& chain_;
    Index segment_;
    double copied_[kDeltaLanes][kCopied];
};

/// Growth of the products of states over all stretches, in all lanes.
class Growth {
  public:
    Growth(int n1, int n2) : n1_(n1), n2_(n2) {
        for (int i = 0; i < n1; ++i) {
            std::fill_n(both_[i], n2, Part{});
            std::fill_n(first_[i], n1, Part{});
        }
        for (int i = 0; i < n2; ++i) std::fill_n(second_[i], n2, Part{});
    }

    void add(const DeltaState& state, double sign) {
        for (int i = 0; i < n1_; ++i) {
            const Part x = sign * state.first[i];
            for (int j = 0; j < n2_; ++j) both_[i][j] += x * state.second[j];
            for (int j = i; j < n1_; ++j) first_[i][j] += x * state.first[j];
        }
        for (int i = 0; i < n2_; ++i)
            for (int j = i; j < n2_; ++j) second_[i][j] += sign * state.second[i] * state.second[j];
    }
    double both(int i, int j) const { return total(both_[i][j]); }
    double first(int i, int j) const { return total(first_[std::min(i, j)][std::max(i, j)]); }
    double second(int i, int j) const { return total(second_[std::min(i, j)][std::max(i, j)]); }

  private:
    int n1_, n2_;
    Part both_[kMaxDeltaOrder][kMaxDeltaOrder], first_[kMaxDeltaOrder][kMaxDeltaOrder],
        second_[kMaxDeltaOrder][kMaxDeltaOrder];
};

class DeltaRun {
  public:
    DeltaRun(const DeltaChain& first, const DeltaChain& second, const DeltaLoops& loops, Index N)
        : first_(first),
          second_(second),
          loops_(loops),
          N_(N),
          segment_(N / kDeltaLanes),
          reader1_(first, segment_),
          reader2_(second, segment_),
          growth_(first.order, second.order) {
        state_.set_zero(first.order, second.order);
        sums_.set_zero(first.order, second.order);
    }

    void run(DeltaProducts& result) {
        find_states();
        run(0, segment_, nullptr);
        keep_last_lane();
        in_lanes_ = false;
        run(kDeltaLanes * segment_, N_, nullptr);
        if (loops_.summed.first)
            set_own(
                first_.order, sums_.first, [&](int i, int j) { return growth_.first(i, j); }, result.first);
        set_own(
            second_highest(), sums_.second, [&](int i, int j) { return growth_.second(i, j); }, result.second);
        set_common(result.both);
    }

  private:
    /// Each lane's first state: it runs over the end of the segment before its own.
    void find_states() {
        FreeMotion free_motion(first_, second_, loops_, segment_);
        run(segment_ - free_motion.back(), segment_, &free_motion.first_units());
        free_motion.hand_over(state_);
    }

    /// Runs steps from .. to - 1, of all segments or, at the end of the data, of one lane; with sums, or with `free`
    /// updated.
    void run(Index from, Index to, DeltaState* free) {
        for (Index k = from; k < to;) {
            Index next = to;
            begin_signal(first_, k, state_.first, next);
            begin_signal(second_, k, state_.second, next);
            if (!free) growth_.add(state_, -1);
            while (k < next) k += advance(k, next, free);
            if (!free) growth_.add(state_, 1);
        }
    }

    /// At the step where a signal begins, its start is added in its lane; stops the run there otherwise.
    void begin_signal(const DeltaChain& chain, Index k, Part* state, Index& next) const {
        if (chain.begin >= N_) return;
        const Index lane = in_lanes_ ? chain.begin / segment_ : 0;
        const Index step = in_lanes_ ? chain.begin % segment_ : chain.begin;
        if (lane >= kDeltaLanes) return;
        if (step > k) next = std::min(next, step);
        if (step != k) return;
        for (int j = 0; j < chain.order; ++j) state[j][lane] += chain.start[static_cast<std::size_t>(j)];
    }

    Index advance(Index k, Index to, DeltaState* free) {
        Index steps = std::min(to - k, kDeltaBlock);
        if (in_lanes_) steps = std::min(reader1_.steps_at_once(k, to - k), reader2_.steps_at_once(k, to - k));
        const SegmentSamples v = in_lanes_ ? reader1_.read(k, steps) : reader1_.read_one_lane(k, steps);
        const SegmentSamples w = in_lanes_ ? reader2_.read(k, steps) : reader2_.read_one_lane(k, steps);
        if (free)
            loops_.filter(first_, second_, v, w, steps, state_, *free);
        else
            loops_.sum(first_, second_, v, w, steps, state_, sums_);
        return steps;
    }

    /// The first lane continues with the rest of the data, from the state of the last lane.
    void keep_last_lane() {
        const auto keep = [](Part& part) {
            const double last = part[kDeltaLanes - 1];
            part = Part{};
            part[0] = last;
        };
        std::for_each_n(state_.first, first_.order, keep);
        std::for_each_n(state_.second, second_.order, keep);
    }

    /// The second chain's last column that is multiplied.
    int second_highest() const { return loops_.summed.highest ? second_.order : second_.order - 1; }

    /// All products of a chain's columns 0 .. n from their squares.
    template <class GrowthOf>
    static void set_own(int n, const Part* squares, const GrowthOf& growth, ColumnMatrix& S) {
        S.resize(n + 1, n + 1);
        for (int s = 2 * n; s >= 0; --s) {
            int j = s / 2, i = s - j;
            // 2 X_j X_(j+1) + X_(j+1)^2 is the difference of X_j^2.
            S(j, i) = S(i, j) = i == j ? total(squares[i]) : (growth(j, j) - S(i, i)) / 2;
            for (; j > 0 && i < n; --j, ++i)
                S(j - 1, i + 1) = S(i + 1, j - 1) = growth(j - 1, i) - S(j, i) - S(j, i + 1);
        }
    }

    void set_common(ColumnMatrix& S) const {
        const int n1 = first_.order, n2 = second_highest();
        S.resize(n1 + 1, n2 + 1);
        for (int s = n1 + n2; s >= 0; --s) {
            const int middle = summed_row(n1, n2, s);
            S(middle, s - middle) = total(sums_.both[s]);
            for (int j = middle, i = s - j; j < n1 && i > 0; ++j, --i)
                S(j + 1, i - 1) = growth_.both(j, i - 1) - S(j, i) - S(j + 1, i);
            for (int j = middle, i = s - j; j > 0 && i < n2; --j, ++i)
                S(j - 1, i + 1) = growth_.both(j - 1, i) - S(j, i) - S(j, i + 1);
        }
    }

    const DeltaChain &first_, &second_;
    DeltaLoops loops_;
    Index N_, segment_;
    bool in_lanes_ = true;
    SegmentReader reader1_, reader2_;
    DeltaState state_;
    DeltaSums sums_;
    Growth growth_;
};

}  // namespace

std::optional<DeltaProducts> delta_products(const DeltaChain& first, const DeltaChain& second, Index N,
                                            RequestedProducts requested) {
    const DeltaLoops loops = delta_loops(first.order, second.order, requested);
    if (!loops.sum || N < kDeltaLanes * kMinDeltaSegmentLength) return {};
    std::optional<DeltaProducts> products(std::in_place);
    DeltaRun(first, second, loops, N).run(*products);
    return products;
}

}  // namespace dynlab::inline numerics
