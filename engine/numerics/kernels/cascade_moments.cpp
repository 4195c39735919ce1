#include "numerics/kernels/cascade_moments.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "numerics/kernels/cascade_basis.h"
#include "numerics/kernels/lanes.h"
#include "numerics/kernels/sample_moments.h"

namespace dynlab {

namespace {

using Part = Lanes::Part;
constexpr int kLanes = Lanes::kWidth;
constexpr Index kShortestSegment = 8;
constexpr double kForgotten = 1e-19;  // what is left of a state after so many steps is less than rounding

Part broadcast(double x) {
    return Part{} + x;
}

double sum_of_lanes(const Part& x) {
    double sum = 0;
    for (int lane = 0; lane < kLanes; ++lane) sum += x[lane];
    return sum;
}

/// A signal and its basis.
struct Source {
    CascadeBasis basis;
    double feed = 0;            ///< where only q is a column
    const double* v = nullptr;  ///< at the lanes' first sample
    Vector state;               ///< there
};

/// What the columns of a cascade are: its states, or, kFed, for two poles and one output, q alone, which
/// q[k+1] = centre q[k] + p[k] + feed v[k] makes a multiple of the output; kTap: after them the sample. kRepeated: the
/// two poles are one, `square` is zero.
template <int kOrder_, bool kFed_, bool kTap_, bool kRepeated_ = false>
struct Shape {
    static constexpr int kOrder = kOrder_;
    static constexpr bool kFed = kFed_;
    static constexpr bool kTap = kTap_;
    static constexpr bool kRepeated = kRepeated_;
    static constexpr int kColumns = (kFed ? 1 : kOrder) + (kTap ? 1 : 0);
};
using NoSignal = Shape<0, false, false>;

/// The states of one signal in all lanes, step by step.
template <class Shape>
class LaneCascade {
  public:
    static constexpr int kOrder = Shape::kOrder;
    using State = Eigen::Matrix<double, kOrder, 1>;
    using Transition = Eigen::Matrix<double, kOrder, kOrder>;

    LaneCascade(const Source& source, Index segment) : v_(source.v), segment_(segment), feed_(broadcast(source.feed)) {
        for (int i = 0; i < kPairs; ++i) {
            const CascadeBasis::Pair& pair = source.basis.pairs[static_cast<std::size_t>(i)];
            centre_[i] = broadcast(pair.centre);
            square_[i] = broadcast(pair.square);
        }
        if constexpr (kOrder > 0) measure_memory(source);
    }

    [[gnu::always_inline]] Part sample(Index k) const {
        if constexpr (Shape::kColumns == 0) return Part{};
        return Lanes::gather_part(v_ + k, segment_);
    }
    /// Asks the memory for what is needed soon: by itself, the processor stops at the end of every page.
    [[gnu::always_inline]] void fetch_ahead(Index k) const {
        constexpr Index kLine = 8, kAhead = 16 * kLine;  // samples
        if (Shape::kColumns == 0 || k % kLine != 0 || k + kAhead >= segment_) return;
        for (int lane = 0; lane < kLanes; ++lane) __builtin_prefetch(v_ + k + kAhead + lane * segment_);
    }
    [[gnu::always_inline]] Part column(int i, const Part& v) const {
        if constexpr (Shape::kFed) return i == 0 ? state_[1] : v;
        if constexpr (kOrder == 0) return v;
        return i < kOrder ? state_[i] : v;
    }
    [[gnu::always_inline]] void step(const Part& v) {
        // From the last pair to the first: each is driven by what the one before has been.
        repeat<kPairs>([&](auto i) {
            constexpr int b = kPairs - 1 - i;
            Part drive = v;
            if constexpr (b > 0) drive = state_[2 * b - 1];
            if constexpr (2 * b + 1 < kOrder) {
                const Part p = state_[2 * b], q = state_[2 * b + 1];
                Part own = p;
                if constexpr (Shape::kFed) own += feed_ * v;
                state_[2 * b + 1] = centre_[b] * q + own;
                if constexpr (!Shape::kRepeated) drive += square_[b] * q;
            }
            state_[2 * b] = centre_[b] * state_[2 * b] + drive;
        });
    }

    const Part& state(int i) const { return state_[i]; }

    /// Samples before a lane's first one that its state remembers, or all of a segment.
    Index back() const { return back_; }
    /// After a run from rest over the end of the segment, each lane's last state is where the next one begins.
    void hand_over(const Vector& start) {
        State x = start;
        for (int lane = 0; lane < kLanes; ++lane) {
            State next;
            for (int i = 0; i < kOrder; ++i) {
                next[i] = state_[i][lane];
                state_[i][lane] = x[i];
            }
            x = next + through_ * x;
        }
    }

  private:
    static constexpr int kPairs = (kOrder + 1) / 2;

    void measure_memory(const Source& source) {
        const Transition F = transition(source);
        Transition power = F;
        for (back_ = 1; back_ < segment_ && power.cwiseAbs().maxCoeff() > kForgotten; back_ *= 2)
            power = (power * power).eval();
        back_ = std::min(back_, segment_);
        through_ = back_ == segment_ ? matrix_power(F, segment_) : Transition(Transition::Zero());
    }
    static Transition transition(const Source& source) {
        Transition F = Transition::Zero();
        for (int i = 0; i < kOrder; ++i) {
            const CascadeBasis::Pair& pair = source.basis.pairs[static_cast<std::size_t>(i / 2)];
            F(i, i) = pair.centre;
            if (i > 0) F(i, i - 1) = 1;
            if (i % 2 == 1) F(i - 1, i) = pair.square;
        }
        return F;
    }
    static Transition matrix_power(Transition square, Index exponent) {
        Transition result = Transition::Identity();
        for (; exponent > 0; exponent /= 2) {
            if (exponent % 2 == 1) result = (result * square).eval();
            square = (square * square).eval();
        }
        return result;
    }

    const double* v_;
    Index segment_, back_ = 0;
    Transition through_;                                                            ///< of a state, over a segment
    Part feed_, centre_[kPairs + 1], square_[kPairs + 1], state_[kOrder + 1] = {};  // an array of none is not allowed
};

/// The states of all lanes at their first samples. Each lane runs over the end of the segment before its own, both
/// signals at once: alone, each would wait for itself.
template <class First, class Second>
[[gnu::always_inline]] inline void find_states(LaneCascade<First>& first, LaneCascade<Second>& second,
                                               const std::array<Source, 2>& sources, Index segment) {
    const Index both = segment - std::min(first.back(), second.back());
    for (Index k = segment - first.back(); k < both; ++k) first.step(first.sample(k));
    for (Index k = segment - second.back(); k < both; ++k) second.step(second.sample(k));
    for (Index k = both; k < segment; ++k) {
        first.step(first.sample(k));
        second.step(second.sample(k));
    }
    if constexpr (First::kOrder > 0) first.hand_over(sources[0].state);
    if constexpr (Second::kOrder > 0) second.hand_over(sources[1].state);
}

/// Which products are wanted: those of the first cascade's columns among themselves, or only with the sample, and those
/// of the second pair of `Second` among themselves.
enum Wanted { kFirstAlone = 1, kFirstWithSample = 2, kSecondPairAlone = 4 };

/// Sums of the products of all columns, first those of `First`, then those of `Second`; zero where they are not wanted.
/// With kFirstWithSample, the places of the states of `First` hold how much these products have grown from the lanes'
/// first steps to their ends.
template <class First, class Second, int kWanted>
Matrix sum_products(const std::array<Source, 2>& sources, Index segment) {
    constexpr int kFirst = First::kColumns, kColumns = kFirst + Second::kColumns;
    constexpr auto left_out = [](int i, int j) {
        if (j < kFirst) return !(kWanted & kFirstAlone) && !(kWanted & kFirstWithSample && j + 1 == kFirst);
        return Second::kOrder == 4 && i >= kFirst + 2 && j < kFirst + 4 && !(kWanted & kSecondPairAlone);
    };
    LaneCascade<First> first(sources[0], segment);
    LaneCascade<Second> second(sources[1], segment);
    find_states(first, second, sources, segment);
    [[maybe_unused]] const LaneCascade<First> start = first;
    Part sums[kColumns][kColumns] = {};
    for (Index k = 0; k < segment; ++k) {
        first.fetch_ahead(k);
        second.fetch_ahead(k);
        const Part v = first.sample(k), w = second.sample(k);
        repeat<kColumns>([&](auto i) {
            const Part x = i < kFirst ? first.column(i, v) : second.column(i - kFirst, w);
            repeat<kColumns>([&](auto j) {
                if constexpr (j >= i && !left_out(i, j))
                    sums[i][j] += x * (j < kFirst ? first.column(j, v) : second.column(j - kFirst, w));
            });
        });
        first.step(v);
        second.step(w);
    }
    if constexpr (kWanted & kFirstWithSample)
        for (int i = 0; i < First::kOrder; ++i)
            for (int j = i; j < First::kOrder; ++j)
                sums[i][j] = first.state(i) * first.state(j) - start.state(i) * start.state(j);
    Matrix total = Matrix::Zero(kColumns, kColumns);
    for (int i = 0; i < kColumns; ++i)
        for (int j = i; j < kColumns; ++j) total(i, j) = total(j, i) = sum_of_lanes(sums[i][j]);
    return total;
}

/// From what sum_products gives with kFirstWithSample for two equal poles c, the sums P, Q, R of p p, p q and q q:
/// squared, p[k+1] = c p[k] + v[k] and q[k+1] = c q[k] + p[k] say how they grow in a step, summed over the record
///     growth of P = (c^2 - 1) P + 2 c <p,v> + <v,v>   and so on
/// (the Lyapunov equation of the record). False where the terms cancel: a signal with little of what the filter passes.
bool complete_squares(Matrix& total, double c) {
    constexpr double kMostCancelled = 10;
    const double left = 1 - c * c, pv = total(0, 2), qv = total(1, 2), vv = total(2, 2);
    const double dP = total(0, 0), dQ = total(0, 1), dR = total(1, 1);
    const double P = (2 * c * pv + vv - dP) / left, size_P = (2 * std::abs(c * pv) + vv + std::abs(dP)) / left;
    const double Q = (c * (P + qv) + pv - dQ) / left;
    const double size_Q = (std::abs(c) * (size_P + std::abs(qv)) + std::abs(pv) + std::abs(dQ)) / left;
    const double R = (2 * c * Q + P - dR) / left, size_R = (2 * std::abs(c) * size_Q + size_P + std::abs(dR)) / left;
    total(0, 0) = P;
    total(0, 1) = total(1, 0) = Q;
    total(1, 1) = R;
    return left > 0 && size_P <= kMostCancelled * P && size_R <= kMostCancelled * R &&
           size_Q <= kMostCancelled * std::sqrt(P * R);
}

using Summation = Matrix (*)(const std::array<Source, 2>&, Index);
template <int value>
using Constant = std::integral_constant<int, value>;

/// The function for these shapes; null where there is none.
template <class First>
Summation summation_for(Index order, bool fed, bool tap, int wanted) {
    Summation found = nullptr;
    const auto try_shape = [&]<class Second>(Second, auto w) {
        if (order == Second::kOrder && fed == Second::kFed && tap == Second::kTap && wanted == w)
            found = &sum_products<First, Second, w>;
    };
    if constexpr (First::kRepeated) {
        try_shape(Shape<2, false, false, true>(), Constant<kFirstWithSample>());
        try_shape(Shape<2, false, true, true>(), Constant<kFirstWithSample>());
        try_shape(Shape<2, true, false, true>(), Constant<kFirstWithSample>());
    } else {
        const auto try_wanted = [&](auto w) {
            try_shape(Shape<1, false, false>(), w);
            try_shape(Shape<1, false, true>(), w);
            try_shape(Shape<2, false, false>(), w);
            try_shape(Shape<2, false, true>(), w);
            try_shape(Shape<2, true, false>(), w);
            try_shape(Shape<4, false, false>(), w);
            try_shape(Shape<4, false, true>(), w);
        };
        try_wanted(Constant<0>());
        try_wanted(Constant<kSecondPairAlone>());
        if constexpr (First::kColumns > 0) {
            try_wanted(Constant<kFirstAlone>());
            try_wanted(Constant<kFirstAlone | kSecondPairAlone>());
        }
    }
    return found;
}

/// Outputs as combinations of columns.
struct Outputs {
    Matrix weights;  ///< outputs x columns
    Index of_first = 0, first_columns = 0;

    /// Whether one of the chosen outputs needs one of these columns.
    bool need(const std::vector<Index>& chosen, Index column, Index count) const {
        return std::any_of(chosen.begin(), chosen.end(),
                           [&](Index output) { return !weights.row(output).segment(column, count).isZero(0); });
    }
};

Outputs outputs_of(const std::array<Source, 2>& sources, bool two, bool fed, bool tap) {
    const CascadeBasis &first = sources[0].basis, &last = sources[1].basis;
    const Index columns = fed ? 1 : last.order + (tap ? 1 : 0), rows = last.outputs.rows();
    Outputs outputs;
    outputs.of_first = two ? first.outputs.rows() : 0;
    outputs.first_columns = two ? first.order + 1 : 0;
    outputs.weights = Matrix::Zero(outputs.of_first + rows, outputs.first_columns + columns);
    if (two) outputs.weights.topLeftCorner(outputs.of_first, outputs.first_columns) = first.outputs;
    outputs.weights.bottomRightCorner(rows, columns) = last.outputs.middleCols(fed ? 1 : 0, columns);
    return outputs;
}

/// Of these products of outputs; `order` is that of the second cascade.
int wanted_products(const Outputs& outputs, Index order, const std::vector<Index>& left,
                    const std::vector<Index>& right) {
    const auto both_need = [&](Index column, Index count) {
        return outputs.need(left, column, count) && outputs.need(right, column, count);
    };
    int wanted = 0;
    if (both_need(0, outputs.first_columns)) wanted |= kFirstAlone;
    if (order == 4 && both_need(outputs.first_columns + 2, 2)) wanted |= kSecondPairAlone;
    return wanted;
}

Summation summation_for(const std::array<Source, 2>& sources, const Outputs& outputs, bool fed, bool tap, int wanted) {
    const Index order = sources[1].basis.order;
    switch (outputs.first_columns) {
        case 0:
            return summation_for<NoSignal>(order, fed, tap, wanted);
        case 1:
            return summation_for<Shape<0, false, true>>(order, fed, tap, wanted);
        case 2:
            return summation_for<Shape<1, false, true>>(order, fed, tap, wanted);
        case 3:
            return summation_for<Shape<2, false, true>>(order, fed, tap, wanted);
        default:
            return nullptr;
    }
}

/// With the wanted products of the first source's columns among themselves from how they grow, where its poles and the
/// second's are repeated and this loses no digits; nothing otherwise.
std::optional<Matrix> sum_by_growth(const std::array<Source, 2>& sources, const Outputs& outputs, bool fed, bool tap,
                                    int wanted, Index segment) {
    const auto repeated = [](const CascadeBasis& basis) { return basis.order == 2 && basis.pairs[0].square == 0; };
    if (wanted != kFirstAlone || outputs.first_columns != 3 || !repeated(sources[0].basis) ||
        !repeated(sources[1].basis))
        return {};
    Matrix total = summation_for<Shape<2, false, true, true>>(2, fed, tap, kFirstWithSample)(sources, segment);
    if (!complete_squares(total, sources[0].basis.pairs[0].centre)) return {};
    return total;
}

/// The two sources, the second alone for one signal; false where there are none.
bool find_bases(const std::vector<FilteredSignal>& signals, std::array<Source, 2>& sources) {
    const auto take = [](std::optional<CascadeBasis> basis, Source& source) {
        if (basis) source.basis = *std::move(basis);
        return basis.has_value();
    };
    const bool joint = signals.size() == 3;
    if (joint && signals[1].signal.data() != signals[2].signal.data()) return false;
    if (signals.size() > 1 && !take(cascade_basis(signals[0].system), sources[0])) return false;
    return take(joint ? joint_basis(signals[1].system, signals[2].system) : cascade_basis(signals.back().system),
                sources[1]);
}

/// Whether the state of the shorter of two systems with a joint basis is what the longer's says of it: the very first
/// samples are not everywhere filtered alike.
bool agree_on_state(const Vector& joint_state, const FilteredSignal& shorter, const Vector& x, double v) {
    constexpr double kRounding = 1e-9;
    const Vector own = cascade_basis(shorter.system)->from_state(x, v);
    return (joint_state.head(2) - own).cwiseAbs().maxCoeff() <= kRounding * own.cwiseAbs().maxCoeff();
}

}  // namespace

std::optional<Matrix> cascade_moments(const std::vector<FilteredSignal>& signals, const std::vector<Index>& left,
                                      const std::vector<Index>& right) {
    if (signals.size() > 3) return {};
    std::array<Source, 2> sources;
    if (!find_bases(signals, sources)) return {};
    Index latest = 0;
    for (const FilteredSignal& signal : signals) latest = std::max(latest, signal.system.delay);
    const Index N = signals.front().signal.size(), segment = std::max<Index>(0, N - latest - 1) / kLanes;
    if (segment < kShortestSegment) return {};
    const Index first = N - kLanes * segment;

    const CascadeBasis& last = sources[1].basis;
    const bool tap = last.sees_tap();
    const bool fed = !tap && last.order == 2 && last.outputs.rows() == 1 && last.outputs(0, 1) != 0;
    if (fed) sources[1].feed = last.outputs(0, 0) / last.outputs(0, 1);
    const bool two = signals.size() > 1;
    const Outputs outputs = outputs_of(sources, two, fed, tap);
    const int wanted = wanted_products(outputs, last.order, left, right);
    const Summation sum = summation_for(sources, outputs, fed, tap, wanted);
    if (!sum) return {};

    const std::vector<OutputSum> no_sums;
    SampleMoments samples(signals, left, right, no_sums);
    samples.run(0, first);
    // Each source begins where the last signal that it stands for is.
    const auto begin_at = [&](Source& source, std::size_t signal) {
        source.v = signals[signal].signal.data() + (first - source.basis.delay);
        source.state = source.basis.from_state(samples.recursion(signal).state(), *source.v);
        // With the feed, p stands for p + feed square q, and q for q + feed p.
        if (source.feed != 0)
            source.state +=
                source.feed * Eigen::Vector2d(source.basis.pairs[0].square * source.state[1], source.state[0]);
    };
    if (two) begin_at(sources[0], 0);
    begin_at(sources[1], signals.size() - 1);
    if (signals.size() == 3 &&
        !agree_on_state(sources[1].state, signals[1], samples.recursion(1).state(), *sources[1].v))
        return {};
    std::optional<Matrix> products = sum_by_growth(sources, outputs, fed, tap, wanted, segment);
    if (!products) products = sum(sources, segment);
    const Matrix with_outputs = products->lazyProduct(outputs.weights.transpose());
    Matrix moments = samples.total();
    for (Index j = 0; j < moments.cols(); ++j)
        for (Index i = 0; i < moments.rows(); ++i)
            moments(i, j) += outputs.weights.row(left[static_cast<std::size_t>(i)])
                                 .dot(with_outputs.col(right[static_cast<std::size_t>(j)]));
    return moments;
}

}  // namespace dynlab
