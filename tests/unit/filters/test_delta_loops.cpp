// Oracle: the definition of the columns and of their products, sample by sample in 80 bits, lane by lane.
#include "numerics/filters/delta_loops.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/signals/random.h"

namespace test_delta_loops {

using namespace dynlab;

constexpr Index kSteps = 5 * kDeltaLanes;

/// Poles that decay, in powers of the difference operator: (delta + 0.3)^n.
DeltaChain chain_of(int order) {
    DeltaChain chain;
    chain.order = order;
    std::vector<double> p{1};  // from delta^0 on
    for (int i = 0; i < order; ++i) {
        p.push_back(0);
        for (std::size_t j = p.size(); j-- > 0;) p[j] = 0.3 * p[j] + (j > 0 ? p[j - 1] : 0);
    }
    for (int j = 0; j < order; ++j) chain.alpha[static_cast<std::size_t>(j)] = p[static_cast<std::size_t>(j)];
    return chain;
}

using Columns = std::vector<std::vector<long double>>;  // by sample

/// From the zero state; after the last sample its states follow.
Columns columns_of(const DeltaChain& chain, const double* samples) {
    const auto n = static_cast<std::size_t>(chain.order);
    Columns all;
    std::vector<long double> x(n + 1, 0);
    for (Index k = 0; k <= kSteps; ++k) {
        x[n] = k < kSteps ? samples[k] : 0;
        for (std::size_t j = 0; j < n; ++j) x[n] -= static_cast<long double>(chain.alpha[j]) * x[j];
        all.push_back(x);
        for (std::size_t j = 0; j < n; ++j) x[j] += x[j + 1];
    }
    return all;
}

struct Orders {
    int first, second;
};

void expect_loops(const Orders& orders, RequestedProducts expected_value) {
    const DeltaLoops loops = delta_loops(orders.first, orders.second, expected_value);
    ASSERT_NE(loops.filter, nullptr) << orders.first << ", " << orders.second;
    ASSERT_TRUE(loops.summed.first || !expected_value.first);
    ASSERT_TRUE(loops.summed.highest || !expected_value.highest);
    const DeltaChain first = chain_of(orders.first), second = chain_of(orders.second);
    const Vector v = RandomStream(1).normal(kSteps * kDeltaLanes), w = RandomStream(2).normal(kSteps * kDeltaLanes);
    DeltaState summed, filtered, free;
    DeltaSums sums;
    for (DeltaState* state : {&summed, &filtered, &free}) state->set_zero(orders.first, orders.second);
    sums.set_zero(orders.first, orders.second);
    loops.sum(first, second, {v.data(), kSteps}, {w.data(), kSteps}, kSteps, summed, sums);
    loops.filter(first, second, {v.data(), kSteps}, {w.data(), kSteps}, kSteps, filtered, free);
    for (int lane = 0; lane < kDeltaLanes; ++lane) {
        const Columns X = columns_of(first, v.data() + lane * kSteps), Y = columns_of(second, w.data() + lane * kSteps);
        const auto expect = [&](double found, long double expected, const char* what) {
            EXPECT_NEAR(found, static_cast<double>(expected), 1e-11 * (1 + std::abs(static_cast<double>(expected))))
                << what << ", orders " << orders.first << " and " << orders.second << ", lane " << lane;
        };
        for (int j = 0; j < orders.first; ++j) {
            expect(summed.first[j][lane], X.back()[static_cast<std::size_t>(j)], "state");
            expect(filtered.first[j][lane], X.back()[static_cast<std::size_t>(j)], "filtered state");
        }
        for (int j = 0; j < orders.second; ++j) {
            expect(summed.second[j][lane], Y.back()[static_cast<std::size_t>(j)], "second state");
            expect(filtered.second[j][lane], Y.back()[static_cast<std::size_t>(j)], "filtered second state");
            EXPECT_EQ(free.second[j][lane], 0);
        }
        const int columns = orders.second + (loops.summed.highest ? 1 : 0);
        for (int s = 0; s < orders.first + columns; ++s) {
            const int j = summed_row(orders.first, columns - 1, s);
            long double product = 0;
            for (std::size_t k = 0; k < kSteps; ++k)
                product += X[k][static_cast<std::size_t>(j)] * Y[k][static_cast<std::size_t>(s - j)];
            expect(sums.both[s][lane], product, "product");
        }
        for (int j = 0; j <= orders.first && loops.summed.first; ++j) {
            long double square = 0;
            for (std::size_t k = 0; k < kSteps; ++k)
                square += X[k][static_cast<std::size_t>(j)] * X[k][static_cast<std::size_t>(j)];
            expect(sums.first[j][lane], square, "square");
        }
    }
}

TEST(delta_loops, filter_and_sum_as_they_are_defined) {
    for (const Orders orders : {Orders{0, 1}, {0, 3}, {0, 5}, {1, 2}, {2, 2}, {2, 3}, {4, 5}, {8, 8}, {9, 9}})
        for (const RequestedProducts expected_value :
             {RequestedProducts{true, true}, {false, true}, {true, false}, {false, false}})
            expect_loops(orders, expected_value);
    // Of a sensitivity's chain beside the output's, the output's own products are never wanted.
    for (const Orders orders : {Orders{1, 2}, {1, 3}, {2, 4}, {2, 5}, {3, 6}, {4, 8}, {4, 9}})
        for (const RequestedProducts expected_value : {RequestedProducts{false, true}, {false, false}})
            expect_loops(orders, expected_value);
}

TEST(delta_loops, of_other_orders_there_are_none) {
    EXPECT_EQ(delta_loops(4, 7, {}).filter, nullptr);
    EXPECT_EQ(delta_loops(4, 7, {}).sum, nullptr);
    EXPECT_EQ(delta_loops(2, 4, {true, true}).sum, nullptr) << "products that are never wanted";
}

}  // namespace test_delta_loops
