#include "numerics/models/impulse_estimate.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kDefaultLags = 70;
constexpr Index kSamplesPerLag = 3;

}  // namespace

void read_dead_time(ImpulseEstimate& estimate, double Ts, Hold hold, double half_width) {
    const Vector& g = estimate.response;
    const auto beyond = [&](Index i) { return std::abs(g[i]) > half_width * estimate.null_std[i]; };
    for (Index i = 0; i + 1 < g.size() && !estimate.first; ++i)
        if (beyond(i) && beyond(i + 1) && g[i] * g[i + 1] > 0) estimate.first = i;
    if (!estimate.first) {
        estimate.message += " No part of it stands out of the noise: the input does not visibly move the output.";
        return;
    }
    const Index first = *estimate.first, dead = std::max<Index>(first - (hold == Hold::kZoh ? 1 : 0), 0);
    estimate.message += " It first stands out of the noise at lag " + std::to_string(first) + " (" +
                        number_text(static_cast<double>(first) * Ts) + " s); ";
    estimate.message += dead == 0 ? "no dead time is visible."
                                  : "the dead time is about " + number_text(static_cast<double>(dead) * Ts) + " s (" +
                                        counted(dead, "sample") + ").";
}

Index lags_or_default(const std::string& caller, Index lags, Index shortest) {
    if (lags < 0)
        throw InvalidArgument(caller + ": the number of lags must be positive, but it is " + std::to_string(lags));
    if (lags == 0) lags = std::max<Index>(1, std::min(kDefaultLags, shortest / 5));
    if (kSamplesPerLag * lags > shortest)
        throw InvalidArgument(caller + ": over " + counted(lags, "lag") + " at least " +
                              std::to_string(kSamplesPerLag * lags) +
                              " samples are needed, but the shortest experiment has " + std::to_string(shortest));
    return lags;
}

}  // namespace dynlab::inline numerics
