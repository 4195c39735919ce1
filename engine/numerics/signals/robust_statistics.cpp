#include "numerics/signals/robust_statistics.h"

#include <algorithm>
#include <cmath>

namespace dynlab::inline numerics {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double median(const VectorView& values) {
    return median(std::vector<double>(values.begin(), values.end()));
}

double quantile_of_sorted(const VectorView& values, double part) {
    const double place = part * static_cast<double>(values.size() - 1);
    const Index below = static_cast<Index>(place), above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double standard_deviation(const VectorView& x) {
    return std::sqrt((x.array() - x.mean()).square().mean());
}

double noise_from_differences(const VectorView& x) {
    constexpr double kNormalMedian = 0.6744897501960817;
    if (x.size() < 3) return 0;
    const Index n = x.size() - 2;
    const Vector differences = (x.head(n) - 2 * x.segment(1, n) + x.tail(n)).cwiseAbs();
    return median(differences) / (kNormalMedian * std::sqrt(6.0));
}

}  // namespace dynlab::inline numerics
