#include "numerics/filters/delta_chain.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dynlab::inline numerics {

namespace {

/// One step of the state without a signal.
ColumnMatrix free_step(const DeltaChain& chain) {
    const int n = chain.order;
    ColumnMatrix F = ColumnMatrix::Identity(n, n);
    for (int j = 0; j < n; ++j) {
        if (j > 0) F(j - 1, j) = 1;
        F(n - 1, j) -= chain.alpha[static_cast<std::size_t>(j)];
    }
    return F;
}

}  // namespace

Index memory_length(const DeltaChain& chain, Index max_length) {
    constexpr double kStateDecay = 1e-19;
    const int n = chain.order;
    if (n == 0) return 0;
    // Differences are measured by the mean pole.
    const double pole = std::pow(std::abs(chain.alpha[0]), 1.0 / n);
    const auto forgotten = [&](const ColumnMatrix& power) {
        double left = 0, row = 1;
        for (int j = 0; j < n; ++j, row *= pole) {
            double scale = 1 / row;
            for (int i = 0; i < n; ++i, scale *= pole) left = std::max(left, std::abs(power(j, i)) * scale);
        }
        return power.allFinite() && left <= kStateDecay;
    };
    std::vector<ColumnMatrix> powers{free_step(chain)};  // over 1, 2, 4, .. steps
    while (!forgotten(powers.back())) {
        if (Index{1} << powers.size() >= 2 * max_length) return max_length;
        powers.push_back(powers.back().lazyProduct(powers.back()));
    }
    if (powers.size() < 2) return std::min<Index>(1, max_length);
    std::size_t i = powers.size() - 2;
    ColumnMatrix reached = powers[i];
    Index steps = Index{1} << i;
    for (int bits = 0; bits < 3 && i > 0; ++bits) {
        --i;
        const ColumnMatrix further = reached.lazyProduct(powers[i]);
        if (forgotten(further)) continue;
        reached = further;
        steps += Index{1} << i;
    }
    return std::min(steps + (Index{1} << i), max_length);
}

}  // namespace dynlab::inline numerics
