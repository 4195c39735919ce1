#include "numerics/signals/repair.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/checks.h"
#include "numerics/signals/quantization.h"
#include "numerics/signals/robust_statistics.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kNormal = 1.4826;  // standard deviation of a normal variable by its median absolute deviation

std::vector<Segment> stretches_of(const std::vector<Index>& places) {
    std::vector<Segment> single;
    for (const Index place : places) single.push_back({place, place});
    return joined(std::move(single));
}

/// The samples that are not good are filled from their good neighbors; `t` may be empty for regular ones.
RepairedSignal bridged(const VectorView& x, const VectorView& t, const std::vector<bool>& good, FillMethod method) {
    RepairedSignal result{x, {}, {}};
    const Index N = x.size();
    const auto is_good = [&good](Index k) { return good[static_cast<std::size_t>(k)]; };
    const auto instant = [&t](Index k) { return t.size() > 0 ? t[k] : static_cast<double>(k); };
    for (Index k = 0; k < N; ++k) {
        if (is_good(k)) continue;
        Index after = k;
        while (after < N && !is_good(after)) ++after;
        const Index before = k - 1;
        for (; k < after; ++k) {
            result.replaced.push_back(k + 1);
            double& value = result.signal[k];
            if (before < 0)
                value = x[after];
            else if (after == N || method == FillMethod::kPrevious)
                value = x[before];
            else
                value = x[before] +
                        (x[after] - x[before]) * (instant(k) - instant(before)) / (instant(after) - instant(before));
        }
    }
    result.stretches = stretches_of(result.replaced);
    return result;
}

/// The step of the grid on which the samples lie, 0 for none. If a signal is constant except for one sample, or one in
/// a hundred, the distance of these samples is no grid step: it is that of the outliers.
double usual_step(const VectorView& x) {
    const double rest = median(x);
    const double rounding = 1e-9 * (x.maxCoeff() - x.minCoeff());
    const Index elsewhere = ((x.array() - rest).abs() > rounding).count();
    return elsewhere <= std::max<Index>(1, x.size() / 100) ? 0 : quantization_of(x).step;
}

/// Hampel's question for one sample.
class MovingMedian {
  public:
    MovingMedian(const VectorView& x, Index half) : x_(x), half_(half) {}

    /// Whether sample k lies within `allowed` of the median of the window around it, or within `threshold` times the
    /// scatter in the window and `rounding`. Windows are cut at the ends. What no median is needed for comes first.
    bool accepts(Index k, double allowed, double threshold, double rounding) {
        const Index N = x_.size(), reach = std::min({half_, k, N - 1 - k});  // one-sided windows would suspect slopes
        const Index first = reach > 0 ? k - reach : k == 0 ? 0 : std::max<Index>(N - 3, 0);
        const Index last = reach > 0 ? k + reach : std::min(first + 2, N - 1);
        const auto [least, largest] = std::minmax_element(x_.data() + first, x_.data() + last + 1);
        if (*largest - *least <= allowed) return true;
        window_.assign(x_.data() + first, x_.data() + last + 1);
        const double center = median(window_), distance = std::abs(x_[k] - center);
        if (distance <= allowed) return true;
        for (double& value : window_) value = std::abs(value - center);
        return distance <= threshold * kNormal * median(window_) + rounding;
    }

  private:
    const VectorView& x_;
    Index half_;
    std::vector<double> window_;
};

}  // namespace

RepairedSignal fill_missing(const VectorView& x, const VectorView& t, std::optional<Index> max_gap, FillMethod method) {
    if (t.size() > 0 && t.size() != x.size())
        throw InvalidArgument("fillmissing: the signal has {}, but the time vector has {}",
                              plural(x.size(), "{} sample", "{} samples"),
                              plural(t.size(), "{} instant", "{} instants"));
    check_instants("fillmissing", t);
    std::vector<bool> good(static_cast<std::size_t>(x.size()));
    for (Index k = 0; k < x.size(); ++k) good[static_cast<std::size_t>(k)] = std::isfinite(x[k]);
    if (std::find(good.begin(), good.end(), true) == good.end())
        throw InvalidArgument("fillmissing: all samples of the signal are missing");
    RepairedSignal result = bridged(x, t, good, method);
    constexpr Index kMaxLineLength = 10;
    const Index max_length = max_gap.value_or(method == FillMethod::kLinear ? kMaxLineLength : x.size());
    for (const auto& [first, last] : result.stretches) {
        if (last - first + 1 <= max_length) continue;
        if (method != FillMethod::kLinear)
            throw InvalidArgument(
                "fillmissing: samples {} to {} are missing, a gap of more than {}. To fill the gap, specify {longest = "
                "{}}",
                first, last, plural(max_length, "{} sample", "{} samples"), last - first + 1);
        throw InvalidArgument(
            "fillmissing: samples {} to {} are missing, a gap of more than {}. For an input that is logged when it "
            "changes, use {method = \"previous\"}. For an output, use the parts before and after the gap as two "
            "experiments. Alternatively, pass only the measured samples to iddata, with their times as {}. The "
            "option {longest = {}} allows linear interpolation across the gap",
            first, last, plural(max_length, "{} sample", "{} samples"), OptionName{"sampling_instants"},
            last - first + 1);
    }
    return result;
}

void OutlierOptions::validate() const {
    if (window < 3 || window % 2 == 0)
        throw InvalidArgument("the window must be an odd number of samples, at least 3, but it is {}", window);
    if (!(threshold > 0) || !std::isfinite(threshold))
        throw InvalidArgument("the threshold must be a positive number of standard deviations, but it is {}",
                              threshold);
}

RepairedSignal replace_outliers(const VectorView& x, const OutlierOptions& options) {
    options.validate();
    check_samples("filloutliers", SignalName::kSignal, x);
    const double scatter = noise_from_differences(x);
    const double step = options.quantization ? *options.quantization : usual_step(x);
    const double rounding = 1.5 * step + 1e-9 * (x.maxCoeff() - x.minCoeff());
    std::vector<bool> good(static_cast<std::size_t>(x.size()));
    const double allowed = options.threshold * scatter + rounding;
    MovingMedian around(x, options.window / 2);
    for (Index k = 0; k < x.size(); ++k)
        good[static_cast<std::size_t>(k)] = around.accepts(k, allowed, options.threshold, rounding);
    return bridged(x, Vector(), good, FillMethod::kLinear);
}

}  // namespace dynlab::inline numerics
