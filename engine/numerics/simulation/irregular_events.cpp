#include "numerics/simulation/irregular_events.h"

#include <algorithm>
#include <cstring>
#include <deque>

namespace dynlab::inline numerics {

namespace {

/// The position of a step; the first is 0.
[[gnu::always_inline]] inline Index place_of_step(Index step) {
    constexpr std::size_t kBlock = IrregularEvents::kBlock, kStretch = IrregularEvents::kStretch;
    const auto number = static_cast<std::size_t>(step), inside = number % kBlock;
    return static_cast<Index>(number - inside + inside % kStretch * IrregularEvents::kSideBySide + inside / kStretch);
}

double slope_behind(const VectorView& u, const VectorView& t, Index sample) {
    return sample + 1 < u.size() ? (u[sample + 1] - u[sample]) / (t[sample + 1] - t[sample]) : 0;
}

/// What the delayed input is between its changes to another level or slope: entry i until instant[i], the last one for
/// ever.
struct InputPieces {
    Vector instant, begin, value, slope;  ///< `value` at `begin`

    InputPieces(const VectorView& u, const VectorView& t, double delay, bool slopes)
        : instant(u.size() + 1), begin(u.size() + 1), value(u.size() + 1), slope(slopes ? u.size() + 1 : 0) {
        Index piece = 0;
        double level = value[0] = 0;
        if (slopes) begin[0] = slope[0] = 0;
        for (Index k = 0; k < u.size(); ++k) {
            const double now = t[k] + delay;
            instant[piece] = now;
            piece += slopes || u[k] != level;
            value[piece] = level = u[k];
            if (!slopes) continue;
            begin[piece] = now;
            slope[piece] = slope_behind(u, t, k);
        }
        instant[piece] = kInfinity;
    }
};

bool is_same(const Vector& a, const VectorView& b) {
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

/// Events and all that they were made of.
struct MadeEvents {
    Vector u, t;
    Hold hold;
    double delay;
    std::shared_ptr<const IrregularEvents> events;

    bool are_of(const VectorView& signal, const VectorView& instants, Hold between, double late) const {
        return delay == late && hold == between && is_same(u, signal) && is_same(t, instants);
    }
};

}  // namespace

IrregularEvents::IrregularEvents(const VectorView& u, const VectorView& t, Hold hold, double delay) {
    const bool slopes = hold == Hold::kFoh;
    reserve((delay > 0 ? 2 : 1) * u.size(), slopes);
    if (slopes)
        set<true>(u, t, delay);
    else
        set<false>(u, t, delay);
}

template <bool kSlopes>
void IrregularEvents::set(const VectorView& u, const VectorView& t, double delay) {
    if (delay > 0)
        merge<kSlopes>(u, t, delay);
    else
        add_samples<kSlopes>(u, t);
    while (count % kBlock != 0) add<kSlopes>(0, 0, 0, -1);
}

void IrregularEvents::reserve(Index max_count, bool slopes) {
    const Index all = (max_count + kBlock - 1) / kBlock * kBlock;
    length.resize(all);
    input.resize(all);
    if (slopes) slope.resize(all);
    sample.resize(static_cast<std::size_t>(all));
}

template <bool kSlopes>
[[gnu::always_inline]] inline void IrregularEvents::add(double seconds, double value, double rise, Index reached) {
    const Index place = place_of_step(count++);
    length[place] = seconds;
    input[place] = value;
    if constexpr (kSlopes) slope[place] = rise;
    sample[static_cast<std::size_t>(place)] = reached;
}

/// Without delay all changes are at samples.
template <bool kSlopes>
void IrregularEvents::add_samples(const VectorView& u, const VectorView& t) {
    add<kSlopes>(0, 0, 0, 0);
    for (Index k = 1; k < u.size(); ++k)
        add<kSlopes>(t[k] - t[k - 1], u[k - 1], kSlopes ? slope_behind(u, t, k - 1) : 0, k);
}

/// A sample comes before a change at the same instant. Without branches: which of them is next cannot be foretold.
template <bool kSlopes>
void IrregularEvents::merge(const VectorView& u, const VectorView& t, double delay) {
    const InputPieces pieces(u, t, delay, kSlopes);
    const double* const instant = pieces.instant.data();
    const double* const sampled = t.data();
    const Index N = u.size();
    double since = t[0];
    for (Index k = 0, piece = 0; k < N;) {
        const Index change = instant[piece] < sampled[k];
        const double until = std::min(instant[piece], sampled[k]);
        double value = pieces.value[piece], rise = 0;
        if constexpr (kSlopes) {
            rise = pieces.slope[piece];
            value += rise * (since - pieces.begin[piece]);
        }
        add<kSlopes>(until - since, value, rise, k | -change);
        since = until;
        piece += change;
        k += 1 - change;
    }
}

std::shared_ptr<const IrregularEvents> recent_events(const VectorView& u, const VectorView& t, Hold hold,
                                                     double delay) {
    constexpr Index kMaxLength = 50'000;  // samples: 5 MB for each of them
    constexpr std::size_t kMax = 4;       // input and output, at the delays before and behind a step
    if (u.size() > kMaxLength) return std::make_shared<const IrregularEvents>(u, t, hold, delay);
    thread_local std::deque<MadeEvents> made;
    const auto found = std::ranges::find_if(made, [&](const MadeEvents& one) { return one.are_of(u, t, hold, delay); });
    if (found != made.end()) {
        std::rotate(made.begin(), found, found + 1);
        return made.front().events;
    }
    if (made.size() == kMax) made.pop_back();
    made.push_front({u, t, hold, delay, std::make_shared<const IrregularEvents>(u, t, hold, delay)});
    return made.front().events;
}

Vector delayed_input(const VectorView& u, const VectorView& t, Hold hold, double delay) {
    if (delay == 0) return u;
    Vector delayed = Vector::Zero(u.size());
    Index next = 0;  // the first sample that has not arrived
    for (Index k = 0; k < u.size(); ++k) {
        while (next < u.size() && t[next] + delay <= t[k]) ++next;
        if (next == 0) continue;
        delayed[k] = u[next - 1];
        if (hold == Hold::kFoh) delayed[k] += slope_behind(u, t, next - 1) * (t[k] - (t[next - 1] + delay));
    }
    return delayed;
}

}  // namespace dynlab::inline numerics
