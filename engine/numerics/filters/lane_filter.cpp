#include "numerics/filters/lane_filter.h"

#include <algorithm>
#include <utility>

namespace dynlab::inline numerics {

namespace {

constexpr double kStateDecay = 1e-19;  // what is left of a state after so many steps is less than rounding

/// Steps after which the free motion is below rounding, a power of two, at most `most`.
Index memory_length(const Matrix& F, Index most) {
    constexpr Index kShort = 512;  // looking is no gain for segments as short as this
    if (most <= kShort) return most;
    Matrix power = F, square = F;
    Index steps = 1;
    for (; steps < most && power.norm() > kStateDecay; steps *= 2) {
        square.noalias() = power.lazyProduct(power);
        power.swap(square);
    }
    return std::min(steps, most);
}

Matrix matrix_power(const Matrix& F, Index exponent) {
    Matrix result = Matrix::Identity(F.rows(), F.rows()), square = F, product = F;
    const auto multiply = [&](Matrix& a, const Matrix& b) {
        product.noalias() = a.lazyProduct(b);
        a.swap(product);
    };
    for (; exponent > 0; exponent /= 2) {
        if (exponent % 2 == 1) multiply(result, square);
        if (exponent > 1) multiply(square, square);
    }
    return result;
}

bool is_cascade(const Matrix& F) {
    const Index half = F.rows() / 2;
    return half > 0 && F.rows() % 2 == 0 && F.topRightCorner(half, half).isZero(0);
}

}  // namespace

LaneFilter::LaneFilter(const FilteredSignal& filtered, Index first, Index segment, const Vector& state)
    : order_(filtered.system.F.rows()),
      segment_(segment),
      sees_next_(!filtered.system.G.col(0).isZero(0)),
      sees_previous_(!filtered.system.G.col(2).isZero(0) || !filtered.system.D.col(1).isZero(0)),
      F_(filtered.system.F),
      G_(filtered.system.G),
      signal_(filtered.signal.data() + (first - filtered.system.delay)),
      step_(step_for(order_, is_cascade(F_), sees_next_, sees_previous_)),
      state_(static_cast<std::size_t>(order_)) {
    plan_outputs(filtered.system.C, filtered.system.D);
    find_segment_states(state);
}

/// An output that is one of the states needs no work of its own; the others are combined from states and input.
void LaneFilter::plan_outputs(const Matrix& C, const Matrix& D) {
    Index columns = order_ + 2;
    for (Index j = 0; j < C.rows(); ++j) {
        std::vector<Term> terms;
        for (Index i = 0; i < order_; ++i)
            if (C(j, i) != 0) terms.push_back({C(j, i), i});
        for (Index i = 0; i < 2; ++i)
            if (D(j, i) != 0) terms.push_back({D(j, i), order_ + i});
        if (terms.size() == 1 && terms[0].weight == 1 && terms[0].column < order_) {
            output_columns_.push_back(terms[0].column);
            continue;
        }
        if (terms.empty()) terms.push_back({0, 0});
        output_columns_.push_back(columns);
        combinations_.push_back({columns++, std::move(terms)});
    }
    keeps_input_ = !D.isZero(0);
    columns_.resize(static_cast<std::size_t>(columns * kBlock));
}

void LaneFilter::find_segment_states(const Vector& state) {
    const Index back = memory_length(F_, segment_);
    position_ = segment_ - back;
    (this->*step_)(back, false);
    const bool whole = back == segment_;
    const Matrix through = whole ? matrix_power(F_, segment_) : Matrix();
    Vector x = state;
    for (int lane = 0; lane < Lanes::kCount; ++lane) {
        Vector next(order_);
        for (Index i = 0; i < order_; ++i) next[i] = state_[static_cast<std::size_t>(i)][lane];
        if (whole) next += through * x;
        for (Index i = 0; i < order_; ++i) state_[static_cast<std::size_t>(i)].set(lane, x[i]);
        x = next;
    }
    position_ = 0;
}

/// Advances the states; keeps them and the input in the columns when asked to. For a cascade the upper right quarter
/// of F is zero.
template <int kOrder, bool kCascade, bool kNext, bool kPrevious>
void LaneFilter::step(Index steps, bool keep) {
    // Copies on the stack: the compiler then knows that writing the columns does not change them.
    double F[kOrder][kOrder], G[3][kOrder];
    std::copy_n(F_.data(), kOrder * kOrder, F[0]);
    std::copy_n(G_.data(), 3 * kOrder, G[0]);
    Lanes x[kOrder], y[kOrder];
    repeat<kOrder>([&](auto i) { x[i] = state_[i]; });
    const double* u = signal_ + position_;
    const Index segment = segment_;
    const bool keep_input = keep && keeps_input_;
    Lanes* const columns = columns_.data();
    Lanes now = Lanes::gather(u, segment), previous = kPrevious ? Lanes::gather(u - 1, segment) : Lanes();
    for (Index k = 0; k < steps; ++k) {
        if (keep) repeat<kOrder>([&](auto i) { columns[i * kBlock + k] = x[i]; });
        if (keep_input) {
            columns[kOrder * kBlock + k] = now;
            if constexpr (kPrevious) columns[(kOrder + 1) * kBlock + k] = previous;
        }
        const Lanes next = Lanes::gather(u + k + 1, segment);
        repeat<kOrder>([&](auto i) {
            y[i] = now.times(G[1][i]);
            if constexpr (kNext) y[i].add(G[0][i], next);
            if constexpr (kPrevious) y[i].add(G[2][i], previous);
            repeat<kOrder>([&](auto j) {
                if constexpr (!kCascade || i >= kOrder / 2 || j < kOrder / 2) y[i].add(F[j][i], x[j]);
            });
        });
        repeat<kOrder>([&](auto i) { x[i] = y[i]; });
        previous = now;
        now = next;
    }
    repeat<kOrder>([&](auto i) { state_[i] = x[i]; });
    position_ += steps;
}

/// The same for any order.
void LaneFilter::step_any(Index steps, bool keep) {
    const Index n = order_;
    std::vector<Lanes> next_state(state_.size());
    for (Index k = 0; k < steps; ++k) {
        const double* u = signal_ + position_ + k;
        const Lanes now = Lanes::gather(u, segment_), next = Lanes::gather(u + 1, segment_);
        const Lanes previous = sees_previous_ ? Lanes::gather(u - 1, segment_) : Lanes();
        if (keep) {
            for (Index i = 0; i < n; ++i) columns_[i * kBlock + k] = state_[i];
            columns_[n * kBlock + k] = now;
            columns_[(n + 1) * kBlock + k] = previous;
        }
        for (Index i = 0; i < n; ++i) {
            Lanes sum = now.times(G_(i, 1));
            sum.add(G_(i, 0), next);
            sum.add(G_(i, 2), previous);
            for (Index j = 0; j < n; ++j) sum.add(F_(i, j), state_[j]);
            next_state[i] = sum;
        }
        state_.swap(next_state);
    }
    position_ += steps;
}

template <int kOrder, bool kCascade>
LaneFilter::Step LaneFilter::step_of(bool next, bool previous) {
    if (next)
        return previous ? &LaneFilter::step<kOrder, kCascade, true, true>
                        : &LaneFilter::step<kOrder, kCascade, true, false>;
    return previous ? &LaneFilter::step<kOrder, kCascade, false, true>
                    : &LaneFilter::step<kOrder, kCascade, false, false>;
}

LaneFilter::Step LaneFilter::step_for(Index order, bool cascade, bool next, bool previous) {
    switch (order) {
        case 1:
            return step_of<1, false>(next, previous);
        case 2:
            return cascade ? step_of<2, true>(next, previous) : step_of<2, false>(next, previous);
        case 3:
            return step_of<3, false>(next, previous);
        case 4:
            return cascade ? step_of<4, true>(next, previous) : step_of<4, false>(next, previous);
        case 6:
            return cascade ? step_of<6, true>(next, previous) : &LaneFilter::step_any;
        case 8:
            return cascade ? step_of<8, true>(next, previous) : &LaneFilter::step_any;
        default:
            return &LaneFilter::step_any;
    }
}

void LaneFilter::combine_outputs(Index steps) {
    for (const Combination& combination : combinations_) {
        Lanes* const sum = columns_.data() + combination.column * kBlock;
        std::size_t done = 0;
        const auto add = [&](auto count) {
            for (; done + count <= combination.terms.size(); done += count)
                add_terms<count>(combination.terms.data() + done, steps, done == 0, sum);
        };
        add(std::integral_constant<std::size_t, 4>());
        add(std::integral_constant<std::size_t, 3>());
        add(std::integral_constant<std::size_t, 2>());
        add(std::integral_constant<std::size_t, 1>());
    }
}

/// sum (= or +=) the first kCount terms, in one pass.
template <std::size_t kCount>
void LaneFilter::add_terms(const Term* terms, Index steps, bool first, Lanes* sum) const {
    const Lanes* x[kCount];
    double weight[kCount];
    for (std::size_t i = 0; i < kCount; ++i) {
        x[i] = columns_.data() + terms[i].column * kBlock;
        weight[i] = terms[i].weight;
    }
    for (Index k = 0; k < steps; ++k) {
        Lanes value = x[0][k].times(weight[0]);
        if (!first) value += sum[k];
        repeat<static_cast<int>(kCount) - 1>([&](auto i) { value.add(weight[i + 1], x[i + 1][k]); });
        sum[k] = value;
    }
}

void LaneFilter::advance(Index steps) {
    (this->*step_)(steps, true);
    combine_outputs(steps);
}

const Lanes* LaneFilter::column(Index output) const {
    return columns_.data() + output_columns_[static_cast<std::size_t>(output)] * kBlock;
}

Vector LaneFilter::last_state() const {
    Vector x(order_);
    for (Index i = 0; i < order_; ++i) x[i] = state_[static_cast<std::size_t>(i)][Lanes::kCount - 1];
    return x;
}

}  // namespace dynlab::inline numerics
