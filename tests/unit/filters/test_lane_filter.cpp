#include "numerics/filters/lane_filter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/filters/sampled_recursion.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"

namespace test_lane_filter {

using namespace dynlab;

/// Largest difference of a lane filter's outputs and last state from the recursion, relative to the largest output.
double difference(const FilteredSignal& filtered, Index first, Index segment) {
    SampledRecursion recursion(filtered.system, filtered.signal);
    const Index p = filtered.system.C.rows(), N = filtered.signal.size();
    Matrix expected(N, p);
    Vector row(p), start, end;
    for (Index k = 0; k < N; ++k) {
        if (k == first) start = recursion.state();
        if (k == first + Lanes::kCount * segment) end = recursion.state();
        recursion.output(k, row);
        expected.row(k) = row.transpose();
        recursion.step(k);
    }
    const Vector sizes = expected.colwise().lpNorm<Eigen::Infinity>().transpose();
    LaneFilter filter(filtered, first, segment, start);
    double largest = 0;
    for (Index done = 0; done < segment; done += LaneFilter::kBlock) {
        const Index steps = std::min(LaneFilter::kBlock, segment - done);
        filter.advance(steps);
        for (Index j = 0; j < p; ++j)
            for (Index k = 0; k < steps; ++k)
                for (int lane = 0; lane < Lanes::kCount; ++lane)
                    largest = std::max(
                        largest, std::abs(filter.column(j)[k][lane] - expected(first + lane * segment + done + k, j)) /
                                     sizes[j]);
    }
    return std::max(largest, (filter.last_state() - end).norm() / end.norm());
}

// oracle: definition, sample by sample (SampledRecursion); orders with and without a loop of their own, segments that
// remember all of the one before or only its end
TEST(lane_filter, agrees_with_the_recursion) {
    const Vector u = RandomStream(1).normal(12'000);
    for (const int order : {1, 2, 3, 4, 5, 6, 8, 9})
        for (const Hold hold : {Hold::kZoh, Hold::kFoh})
            for (const double delay : {0.0, 0.15, 0.17})
                for (const Index segment : {8, 100, 1400}) {
                    const Vector den = power(Eigen::Vector2d(1, 2), order);
                    const FilteredSignal filtered{derivative_filter(den, 0.05, hold, delay), {u.data(), u.size()}};
                    EXPECT_LT(difference(filtered, 11, segment), 1e-12)
                        << "order " << order << ", delay " << delay << ", segments of " << segment;
                }
}

}  // namespace test_lane_filter
