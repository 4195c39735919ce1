#include "numerics/models/impulse_estimate.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kDefaultLags = 70;
constexpr Index kSamplesPerLag = 3;

}  // namespace

void read_dead_time(ImpulseEstimate& estimate, double Ts, const std::string& unit, Hold hold, double half_width) {
    const Vector& g = estimate.response;
    const auto beyond = [&](Index i) { return std::abs(g[i]) > half_width * estimate.null_std[i]; };
    for (Index i = 0; i + 1 < g.size() && !estimate.first; ++i)
        if (beyond(i) && beyond(i + 1) && g[i] * g[i + 1] > 0) estimate.first = i;
    if (!estimate.first) {
        estimate.message = sentences(
            {estimate.message,
             Message("The response never exceeds the noise: the input has no detectable effect on the output.")});
        return;
    }
    const Index first = *estimate.first, dead = std::max<Index>(first - (hold == Hold::kZoh ? 1 : 0), 0);
    const double first_time = static_cast<double>(first) * Ts, dead_time = static_cast<double>(dead) * Ts;
    const Message found =
        dead == 0
            ? Message("The response first exceeds the noise at lag {} ({} {}); no dead time was detected.", first,
                      first_time, unit)
            : Message("The response first exceeds the noise at lag {} ({} {}); the dead time is about {} {} ({}).",
                      first, first_time, unit, dead_time, unit, plural(dead, "{} sample", "{} samples"));
    estimate.dead_time = dead_time;
    estimate.message = sentences({estimate.message, found});
}

Index lags_or_default(const std::string& caller, Index lags, Index shortest) {
    if (lags < 0)
        throw InvalidArgument("{}: the number of lags must be positive, or 0 for the default number, but it is {}",
                              caller, lags);
    if (lags == 0) lags = std::max<Index>(1, std::min(kDefaultLags, shortest / 5));
    if (kSamplesPerLag * lags > shortest)
        throw InvalidArgument("{}: {} need at least {} samples, but the shortest experiment has {}. Use fewer lags",
                              caller, plural(lags, "{} lag", "{} lags"), kSamplesPerLag * lags, shortest);
    return lags;
}

}  // namespace dynlab::inline numerics
