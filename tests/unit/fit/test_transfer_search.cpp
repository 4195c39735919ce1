#include <gtest/gtest.h>

#include <cmath>

#include "numerics/fit/diagnosis.h"
#include "numerics/fit/search_starts.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/signals/random.h"
#include "support/transfer_cases.h"

namespace test_transfer_search {

using namespace dynlab;
using namespace dynlab::test;

/// 3 exp(-0.4 s)/(s^2 + 2s + 4) with a little noise, N samples about `step` (s) apart.
IdData irregular_record(Index N, double step, std::uint32_t seed) {
    const Vector jitter = RandomStream(seed).uniform(N), noise = RandomStream(seed + 1).normal(N);
    const Vector levels = RandomStream(seed + 2).normal(N);
    Vector t(N), u(N);
    for (Index k = 0; k < N; ++k) {
        t[k] = step * (static_cast<double>(k) + 0.5 * jitter[k]);
        u[k] = levels[static_cast<Index>(t[k])] > 0 ? 1 : -1;
    }
    const TransferFunction G = TransferFunction(values({3}), values({1, 2, 4})).with_delay(0.4);
    return IdData(Matrix(lsim(G, u, t) + 0.02 * noise), Matrix(u), t);
}

// A fast short experiment and a slow long one, in either order.
struct Orders {
    IdData fast = irregular_record(300, 0.02, 1), slow = irregular_record(400, 0.2, 11);
    IdData fast_first = IdData::merge({fast, slow}), slow_first = IdData::merge({slow, fast});
};

TEST(transfer_search, the_order_of_unequal_experiments_does_not_matter) {  // oracle: invariance
    const Orders orders;
    TransferStructure structure = TransferStructure::single(2, 0);
    structure.free_delays = true;
    EXPECT_EQ(likely_largest_delay(orders.fast_first), likely_largest_delay(orders.slow_first));
    FitOptions options;
    options.largest_delay = 1.4;
    const DelayScan one = scan_delays(orders.fast_first, structure, options);
    const DelayScan other = scan_delays(orders.slow_first, structure, options);
    ASSERT_EQ(one.delays.size(), other.delays.size());
    EXPECT_EQ(one.delays, other.delays);
    EXPECT_LT(relative_difference(one.losses, other.losses), 1e-9);
    const TransferStructure fixed = TransferStructure::single(2, 0, 0.4);
    EXPECT_LT(relative_difference(best_cutoff_start(orders.fast_first, fixed, {}),
                                  best_cutoff_start(orders.slow_first, fixed, {})),
              1e-9);
}

TEST(transfer_search, the_likely_delay_leaves_the_shortest_record_room) {  // oracle: the promised quarter
    const IdData brief = irregular_record(80, 0.005, 21), slow = irregular_record(400, 0.2, 11);
    for (const IdData& data : {IdData::merge({brief, slow}), IdData::merge({slow, brief})})
        EXPECT_LE(likely_largest_delay(data), shortest_record(data) / 4);
}

}  // namespace test_transfer_search
