#include "numerics/signals/quantisation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dynlab::inline numerics {

Quantisation quantisation_of(const VectorView& x) {
    std::vector<double> values(x.begin(), x.end());
    std::sort(values.begin(), values.end());
    const double range = values.empty() ? 0 : values.back() - values.front();
    const auto equal = [range](double a, double b) { return b - a <= 1e-9 * range; };
    values.erase(std::unique(values.begin(), values.end(), equal), values.end());
    Quantisation found{0, static_cast<Index>(values.size())};
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
