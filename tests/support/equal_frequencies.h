#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace dynlab::test {

/// Whether counts of real random draws are those of equally likely kinds: Pearson's statistic below
/// k + 2 sqrt(k t) + 2 t, t = 24, which chi-squared of k degrees exceeds with a probability of at most
/// exp(-t) = 4e-11 (Laurent and Massart 2000, lemma 1).
inline void expect_equal_frequencies(const std::vector<int>& counts) {
    const double draws = std::accumulate(counts.begin(), counts.end(), 0.0);
    const double expected = draws / static_cast<double>(counts.size());
    const double degrees = static_cast<double>(counts.size()) - 1, t = 24;
    double sum = 0;
    for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
    EXPECT_LT(sum, degrees + 2 * std::sqrt(degrees * t) + 2 * t) << counts.size() << " kinds";
}

}  // namespace dynlab::test
