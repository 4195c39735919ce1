#include "numerics/simulation/irregular_filter.h"

#include <algorithm>
#include <utility>

#include "numerics/error.h"
#include "numerics/simulation/eight_steps.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kStretch = 32;                    // events, one behind the other
constexpr Index kBlock = kSideBySide * kStretch;  // side by side

/// Where an event stands: those that are run side by side lie beside each other.
Index place_of(Index event) {
    const auto number = static_cast<std::size_t>(event), inside = number % kBlock;
    return static_cast<Index>(number - inside + inside % kStretch * kSideBySide + inside / kStretch);
}

}  // namespace

/// Steps from event to event, from the first sample to the last; those that fill up the last block take no time.
struct IrregularFilter::Events {
    Vector length;              // s
    Vector input, slope;        // at the beginning; slopes with straight lines only
    std::vector<Index> sample;  // that is reached, -1 for none
    Index count = 0;

    Events(Index most, bool slopes) {
        const Index all = (most + kBlock - 1) / kBlock * kBlock;
        length.resize(all);
        input.resize(all);
        if (slopes) slope.resize(all);
        sample.resize(static_cast<std::size_t>(all));
    }
    [[gnu::always_inline]] void add(double seconds, double value, double rise, Index reached) {
        const Index place = place_of(count++);
        length[place] = seconds;
        input[place] = value;
        if (slope.size() > 0) slope[place] = rise;
        sample[static_cast<std::size_t>(place)] = reached;
    }
    void fill_up() {
        while (count % kBlock != 0) add(0, 0, 0, -1);
    }
};

IrregularFilter::IrregularFilter(const Matrix& A, const Vector& B, const Matrix& C, Vector D, Hold hold, double delay)
    : series_(A), C_(C), D_(std::move(D)), hold_(hold), delay_(delay) {
    if (B.size() > 0 && (B[0] != 1 || !B.tail(B.size() - 1).isZero(0)))
        throw InvalidArgument("Irregular sampling wants inputs that drive the first state alone");
    if (A.rows() > 0) C_ = C * series_.scale.asDiagonal();
}

/// The slope of the input behind sample `segment`.
double IrregularFilter::slope_behind(const VectorView& u, const VectorView& t, Index segment) const {
    if (hold_ == Hold::kZoh || segment + 1 == u.size()) return 0;
    return (u(segment + 1) - u(segment)) / (t(segment + 1) - t(segment));
}

/// And the input at all samples.
IrregularFilter::Events IrregularFilter::events(const VectorView& u, const VectorView& t, Vector& input) const {
    const Index N = u.size();
    Events events(delay_ > 0 ? 2 * N : N, hold_ == Hold::kFoh);  // without delay all changes are samples
    input.resize(N);
    double since = t(0), until = t(0) + delay_, value = 0, slope = 0;
    Index next = 0;  // the sample with which the input changes
    const auto change = [&]() __attribute__((always_inline)) {
        since = until;
        value = u(next);
        slope = slope_behind(u, t, next);
        // Samples that change nothing of a held input make no step of their own.
        for (++next; hold_ == Hold::kZoh && next < N && u(next) == value;) ++next;
        until = next < N ? t(next) + delay_ : kInfinity;
    };
    for (Index k = 0; k < N; ++k) {
        while (until < t(k)) {
            if (until > since) events.add(until - since, value, slope, -1);
            change();
        }
        events.add(t(k) - since, value, slope, k);
        value += slope * (t(k) - since);
        since = t(k);
        while (until <= t(k)) change();
        input[k] = value;
    }
    events.fill_up();
    return events;
}

template <int kOrder, bool kTwice>
void IrregularFilter::run_sized(const Events& events, Vector start, Matrix& states) const {
    using Steps = EightSteps<kOrder, kTwice>;
    Steps steps(series_, hold_ == Hold::kFoh);
    const Index size = steps.states(), entries = steps.entries();
    std::vector<Eight> maps(static_cast<std::size_t>((kStretch + 1) * entries));
    Eight* const whole = maps.data() + kStretch * entries;  // the maps of whole stretches
    typename Steps::States x(kSideBySide, size), begin(kSideBySide, size);
    std::vector<typename Steps::States> reached(kStretch, x);
    const auto eight = [&](const Vector& values, Index first) __attribute__((always_inline)) {
        return values.size() > 0 ? Eight(Eight::Map(values.data() + first)) : Eight(Eight::Zero());
    };
    for (Index block = 0; block < events.count; block += kBlock) {
        const StepPlan plan(series_, events.length.segment<kBlock>(block).maxCoeff());
        Eight seconds = Eight::Zero();
        x.setZero();
        for (Index i = 0; i < kStretch; ++i) {
            const Index first = block + i * kSideBySide;
            const Eight length = eight(events.length, first);
            steps.set(length, plan, maps.data() + i * entries);
            steps.advance(maps.data() + i * entries, eight(events.input, first), eight(events.slope, first), x);
            seconds += length;
        }
        steps.set(seconds, StepPlan(series_, seconds.maxCoeff()), whole);
        begin.row(0) = start.transpose();
        steps.chain(whole, x, begin);
        x = begin;
        for (Index i = 0; i < kStretch; ++i) {
            const Index first = block + i * kSideBySide;
            steps.advance(maps.data() + i * entries, eight(events.input, first), eight(events.slope, first), x);
            for (Index state = 0; state < size; ++state) reached[static_cast<std::size_t>(i)].col(state) = x.col(state);
        }
        start = x.row(kSideBySide - 1).transpose();
        for (Index lane = 0; lane < kSideBySide; ++lane)
            for (Index i = 0; i < kStretch; ++i) {
                const Index k = events.sample[static_cast<std::size_t>(block + i * kSideBySide + lane)];
                if (k < 0) continue;
                for (Index state = 0; state < size; ++state)
                    states(k, state) = reached[static_cast<std::size_t>(i)](lane, state);
            }
    }
}

template <bool kTwice>
void IrregularFilter::run_systems(const Events& events, const Vector& start, Matrix& states) const {
    switch (series_.order) {
        case 1:
            return run_sized<1, kTwice>(events, start, states);
        case 2:
            return run_sized<2, kTwice>(events, start, states);
        case 3:
            return run_sized<3, kTwice>(events, start, states);
        case 4:
            return run_sized<4, kTwice>(events, start, states);
        case 5:
            return run_sized<5, kTwice>(events, start, states);
        default:
            return run_sized<Eigen::Dynamic, kTwice>(events, start, states);
    }
}

Matrix IrregularFilter::run(const VectorView& u, const VectorView& t, const Vector& x) const {
    Vector input;
    const Events all = events(u, t, input);
    Matrix y = input * D_.transpose();
    if (C_.cols() == 0) return y;
    Matrix states(u.size(), C_.cols());
    const Vector start = x.cwiseQuotient(series_.scale);
    if (series_.twice)
        run_systems<true>(all, start, states);
    else
        run_systems<false>(all, start, states);
    for (Index i = 0; i < y.cols(); ++i)
        for (Index j = 0; j < states.cols(); ++j)
            if (C_(i, j) != 0) y.col(i) += C_(i, j) * states.col(j);
    return y;
}

}  // namespace dynlab::inline numerics
