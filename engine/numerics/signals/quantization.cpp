#include "numerics/signals/quantization.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dynlab::inline numerics {

namespace {

/// The samples in rising order: first into many narrow ranges of values, then within each.
std::vector<double> sorted_values(const VectorView& x) {
    constexpr Index kTogether = 64;  // samples in a range, were they spread evenly
    std::vector<double> values(x.begin(), x.end());
    const Index ranges = x.size() / kTogether;
    const double least = ranges > 1 ? x.minCoeff() : 0, width = ranges > 1 ? x.maxCoeff() - least : 0;
    if (!(width > 0) || !std::isfinite(width)) {
        std::sort(values.begin(), values.end());
        return values;
    }
    const auto range_of = [&](double value) {
        return static_cast<std::size_t>((value - least) / width * static_cast<double>(ranges - 1));
    };
    std::vector<std::size_t> ends(static_cast<std::size_t>(ranges) + 1, 0);
    for (const double value : x) ++ends[range_of(value) + 1];
    for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
    std::vector<std::size_t> next(ends.begin(), ends.end() - 1);
    for (const double value : x) values[next[range_of(value)]++] = value;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        std::sort(values.begin() + static_cast<std::ptrdiff_t>(ends[i]),
                  values.begin() + static_cast<std::ptrdiff_t>(ends[i + 1]));
    return values;
}

}  // namespace

Quantization quantization_of(const VectorView& x) {
    std::vector<double> values = sorted_values(x);
    const double range = values.empty() ? 0 : values.back() - values.front();
    const auto equal = [range](double a, double b) { return b - a <= 1e-9 * range; };
    values.erase(std::unique(values.begin(), values.end(), equal), values.end());
    Quantization found{0, static_cast<Index>(values.size())};
    if (values.size() < 2 || 2 * found.levels > x.size()) return found;
    double step = range;
    for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
    step = range / std::round(range / step);  // the rounding of the values is spread over the whole range
    for (const double value : values) {
        const double multiple = (value - values.front()) / step;
        if (std::abs(multiple - std::round(multiple)) > 0.02) return found;
    }
    found.step = step;
    return found;
}

}  // namespace dynlab::inline numerics
