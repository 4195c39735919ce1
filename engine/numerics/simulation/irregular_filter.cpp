#include "numerics/simulation/irregular_filter.h"

#include <algorithm>
#include <utility>

#include "numerics/error.h"
#include "numerics/linalg/known_order.h"
#include "numerics/simulation/eight_modes.h"
#include "numerics/simulation/eight_steps.h"
#include "numerics/simulation/irregular_events.h"

namespace dynlab::inline numerics {

namespace {

/// The states behind the events at the samples, N rows, by the maps that `steps` makes.
template <class Steps>
void run_events(Steps steps, const IrregularEvents& events, Vector start, Matrix& states) {
    constexpr Index kStretch = IrregularEvents::kStretch, kBlock = IrregularEvents::kBlock;
    const Index size = steps.states(), entries = steps.entries();
    std::vector<Eight> maps(static_cast<std::size_t>((kStretch + 1) * entries));
    Eight* const whole = maps.data() + kStretch * entries;  // the maps of whole stretches
    typename Steps::States x = Steps::States::Zero(kSideBySide, size), begin = x;
    std::vector<typename Steps::States> reached(kStretch, x);
    const auto eight = [&](const Vector& values, Index first) __attribute__((always_inline)) {
        return values.size() > 0 ? Eight(Eight::Map(values.data() + first)) : Eight(Eight::Zero());
    };
    for (Index block = 0; block < events.count; block += kBlock) {
        steps.prepare(events.length.segment<kBlock>(block).maxCoeff());
        Eight seconds = Eight::Zero();
        x.setZero();
        for (Index i = 0; i < kStretch; ++i) {
            const Index first = block + i * kSideBySide;
            const Eight length = eight(events.length, first);
            steps.set(length, maps.data() + i * entries);
            steps.advance(maps.data() + i * entries, eight(events.input, first), eight(events.slope, first), x);
            seconds += length;
        }
        steps.prepare(seconds.maxCoeff());
        steps.set(seconds, whole);
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
void run_series(const CompanionSeries& series, const IrregularEvents& events, const Vector& start, Matrix& states) {
    const bool ramps = events.slope.size() > 0;
    with_known_order<Eigen::Dynamic, 1, 2, 3, 4, 5>(
        series.order, [&](auto order) { run_events(EightSteps<order, kTwice>(series, ramps), events, start, states); });
}

template <bool kTwice>
void run_modes(const SeparateModes& modes, const IrregularEvents& events, const Vector& start, Matrix& states) {
    const bool ramps = events.slope.size() > 0;
    with_known_order<4, 1, 2, 3>(modes.poles.size(), [&](auto order) {
        run_events(EightModes<order, kTwice>(modes, ramps), events, start, states);
    });
}

/// y += C states, C often with few entries.
void add_outputs(const Matrix& C, const Matrix& states, Matrix& y) {
    for (Index i = 0; i < y.cols(); ++i)
        for (Index j = 0; j < states.cols(); ++j)
            if (C(i, j) != 0) y.col(i) += C(i, j) * states.col(j);
}

}  // namespace

IrregularFilter::IrregularFilter(const Matrix& A, const Vector& B, Matrix C, Vector D, Hold hold, double delay)
    : pair_(companion_pair(A)), C_(std::move(C)), D_(std::move(D)), hold_(hold), delay_(delay) {
    if (B.size() > 0 && (B[0] != 1 || !B.tail(B.size() - 1).isZero(0)))
        throw InvalidArgument("Irregular sampling needs inputs that drive only the first state");
}

Matrix IrregularFilter::run(const VectorView& u, const VectorView& t, const Vector& x) const {
    Matrix y = Matrix::Zero(u.size(), D_.size());
    if (!D_.isZero(0)) y = delayed_input(u, t, hold_, delay_) * D_.transpose();
    if (C_.cols() == 0) return y;
    const auto events = recent_events(u, t, hold_, delay_);
    Matrix states(u.size(), C_.cols());
    if (const auto modes = x.isZero(0) ? separate_modes(pair_) : std::nullopt) {
        if (pair_.twice)
            run_modes<true>(*modes, *events, x, states);
        else
            run_modes<false>(*modes, *events, x, states);
        add_outputs(C_ * modes->states, states, y);
        return y;
    }
    const CompanionSeries series(pair_);
    const Vector start = x.cwiseQuotient(series.scale);
    if (series.twice)
        run_series<true>(series, *events, start, states);
    else
        run_series<false>(series, *events, start, states);
    add_outputs(C_ * series.scale.asDiagonal(), states, y);
    return y;
}

}  // namespace dynlab::inline numerics
