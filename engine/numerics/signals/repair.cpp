#include "numerics/signals/repair.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/number_text.h"
#include "numerics/signals/checks.h"
#include "numerics/signals/quantisation.h"
#include "numerics/signals/robust_statistics.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kNormal = 1.4826;  // standard deviation of a normal variable by its median absolute deviation

std::vector<Segment> stretches_of(const std::vector<Index>& places) {
    std::vector<Segment> single;
    for (const Index place : places) single.push_back({place, place});
    return joined(std::move(single));
}

/// Straight lines over the samples that are not good.
RepairedSignal bridged(const VectorView& x, const Vector& t, const std::vector<bool>& good) {
    RepairedSignal result{x, {}, {}};
    std::vector<double> known_t, known_x;
    for (Index k = 0; k < x.size(); ++k) {
        if (!good[static_cast<std::size_t>(k)]) {
            result.replaced.push_back(k + 1);
            continue;
        }
        known_t.push_back(t[k]);
        known_x.push_back(x[k]);
    }
    for (const Index place : result.replaced) {
        const double at = t[place - 1];
        const auto after = std::upper_bound(known_t.begin(), known_t.end(), at);
        const auto i = static_cast<std::size_t>(after - known_t.begin());
        double& value = result.signal[place - 1];
        if (i == 0)
            value = known_x.front();
        else if (i == known_t.size())
            value = known_x.back();
        else
            value =
                known_x[i - 1] + (known_x[i] - known_x[i - 1]) * (at - known_t[i - 1]) / (known_t[i] - known_t[i - 1]);
    }
    result.stretches = stretches_of(result.replaced);
    return result;
}

Vector counted(Index count) {
    return Vector::LinSpaced(count, 1, static_cast<double>(count));
}

/// Median of the window around every sample, and the median distance from it; windows are cut at the ends.
void moving_medians(const VectorView& x, Index half, Vector& centre, Vector& spread) {
    const Index N = x.size();
    centre.resize(N), spread.resize(N);
    std::vector<double> window;
    for (Index k = 0; k < N; ++k) {
        const Index reach = std::min({half, k, N - 1 - k});  // a one-sided window would suspect every slope
        const Index first = reach > 0 ? k - reach : k == 0 ? 0 : std::max<Index>(N - 3, 0);
        const Index last = reach > 0 ? k + reach : std::min(first + 2, N - 1);
        window.assign(x.begin() + first, x.begin() + last + 1);
        centre[k] = median(window);
        for (double& value : window) value = std::abs(value - centre[k]);
        spread[k] = median(window);
    }
}

}  // namespace

RepairedSignal fill_missing(const VectorView& x, const VectorView& t, Index longest) {
    if (t.size() > 0 && t.size() != x.size())
        throw InvalidArgument("fillmissing: there are " + std::to_string(x.size()) + " samples but " +
                              std::to_string(t.size()) + " instants");
    check_instants("fillmissing", t);
    std::vector<bool> good(static_cast<std::size_t>(x.size()));
    for (Index k = 0; k < x.size(); ++k) good[static_cast<std::size_t>(k)] = std::isfinite(x[k]);
    if (std::find(good.begin(), good.end(), true) == good.end())
        throw InvalidArgument("fillmissing: the signal has no sample that is a number");
    RepairedSignal result = bridged(x, t.size() > 0 ? Vector(t) : counted(x.size()), good);
    for (const auto& [first, last] : result.stretches)
        if (last - first + 1 > longest)
            throw InvalidArgument("fillmissing: samples " + std::to_string(first) + " to " + std::to_string(last) +
                                  " are missing, and a straight line over more than " + std::to_string(longest) +
                                  " samples would be invention; use the parts before and after the gap as two "
                                  "experiments, or allow it with {longest = " +
                                  std::to_string(last - first + 1) + "}");
    return result;
}

void OutlierOptions::validate() const {
    if (window < 3 || window % 2 == 0)
        throw InvalidArgument("the window must be an odd number of samples from 3 on, but it is " +
                              std::to_string(window));
    if (!(threshold > 0) || !std::isfinite(threshold))
        throw InvalidArgument("the threshold must be a positive number of standard deviations, but it is " +
                              number_text(threshold));
}

RepairedSignal replace_outliers(const VectorView& x, const OutlierOptions& options) {
    options.validate();
    check_samples("filloutliers", "the signal", x);
    Vector centre, spread;
    moving_medians(x, options.window / 2, centre, spread);
    const Vector distance = (x - centre).cwiseAbs();
    const double scatter = noise_from_differences(x);
    const double rounding = 1.5 * quantisation_of(x).step + 1e-9 * (x.maxCoeff() - x.minCoeff());
    std::vector<bool> good(static_cast<std::size_t>(x.size()));
    for (Index k = 0; k < x.size(); ++k)
        good[static_cast<std::size_t>(k)] =
            distance[k] <= options.threshold * std::max(scatter, kNormal * spread[k]) + rounding;
    return bridged(x, counted(x.size()), good);
}

}  // namespace dynlab::inline numerics
