#include "figures/histogram.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/robust_statistics.h"

namespace dynlab::inline figures {
namespace {

constexpr Index kMaxBins = 200, kMaxRequestedBins = 100'000;

void check_finite(const VectorView& values) {
    constexpr double kMaxValue = 1e300;  // differences of such values are numbers still
    for (Index i = 0; i < values.size(); ++i)
        if (!(std::abs(values[i]) <= kMaxValue))
            throw InvalidArgument("a histogram needs finite values, but value {} is {}", i + 1, values[i]);
}

void check_sample(const VectorView& values) {
    if (values.size() == 0) throw InvalidArgument("a histogram needs at least one value, but none was given");
    check_finite(values);
}

}  // namespace

Index freedman_diaconis_bins(const VectorView& values) {
    check_sample(values);
    Vector sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const double n = static_cast<double>(sorted.size()), range = sorted[sorted.size() - 1] - sorted[0];
    const double width = 2 * (quantile_of_sorted(sorted, 0.75) - quantile_of_sorted(sorted, 0.25)) / std::cbrt(n);
    if (!(range > 0)) return 1;
    const double bins = width > 0 ? range / width : std::sqrt(n);
    return static_cast<Index>(std::clamp(std::ceil(bins - 1e-9), 1.0, static_cast<double>(kMaxBins)));
}

HistogramBins histogram_bins(const VectorView& values, Index bins) {
    check_sample(values);
    if (bins < 1) throw InvalidArgument("a histogram needs at least one bin, not {}", bins);
    if (bins > kMaxRequestedBins)
        throw InvalidArgument("a histogram can have at most {} bins, but {} were requested", kMaxRequestedBins, bins);
    double low = values.minCoeff(), high = values.maxCoeff();
    if (!(low < high)) {
        const double padding = low == 0 ? 0.5 : std::max(0.05 * std::abs(low), 1e-290);
        low -= padding, high += padding;
    }
    return histogram_bins(values, Vector::LinSpaced(bins + 1, low, high));
}

HistogramBins histogram_bins(const VectorView& values, const Vector& edges) {
    check_finite(values);
    if (edges.size() < 2) throw InvalidArgument("a histogram needs at least two bin edges, not {}", edges.size());
    const Index bins = edges.size() - 1;
    HistogramBins result{edges, Vector::Zero(bins)};
    for (const double value : values) {
        const auto right = std::upper_bound(result.edges.begin(), result.edges.end(), value);
        result.counts[std::clamp(static_cast<Index>(right - result.edges.begin()) - 1, Index{0}, bins - 1)] += 1;
    }
    return result;
}

Figure histogram(const VectorView& values, const HistogramOptions& options) {
    const HistogramBins bins =
        options.edges ? histogram_bins(values, *options.edges)
                      : histogram_bins(values, options.bins > 0 ? options.bins : freedman_diaconis_bins(values));
    const Index count = bins.counts.size();
    Curve bars;
    bars.style = CurveStyle::kBars;
    bars.x = 0.5 * (bins.edges.head(count) + bins.edges.tail(count));
    bars.y = bins.counts;
    bars.label = options.label;
    Panel panel;
    panel.x_label = options.x_label;
    panel.y_label = options.y_label;
    const double width = bins.edges[1] - bins.edges[0];
    panel.x_range = {std::min(bins.edges[0], options.truth.value_or(bins.edges[0])) - 0.5 * width,
                     std::max(bins.edges[count], options.truth.value_or(bins.edges[count])) + 0.5 * width};
    constexpr double kFew = 5;  // the axis would have halves between the counts
    if (bins.counts.maxCoeff() == 0) panel.y_range = {0, 1};
    if (bins.counts.maxCoeff() <= kFew) panel.y_tick_step = 1;
    panel.curves = {std::move(bars)};
    if (options.truth) panel.references = {{false, *options.truth, options.truth_label, 1}};
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
