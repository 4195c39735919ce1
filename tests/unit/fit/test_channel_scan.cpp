#include "numerics/fit/channel_scan.h"

#include <gtest/gtest.h>

#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace test_channel_scan {

using namespace dynlab;

TransferStructure two_inputs(Denominators sharing, bool free_delays) {
    TransferStructure structure = TransferStructure::grid(1, 2, sharing, {1}, {0}, {0});
    structure.free_delays = free_delays;
    return structure;
}

TEST(channel_scan, is_for_inputs_with_delays_and_denominators_of_their_own) {
    EXPECT_TRUE(has_separate_channels(two_inputs(Denominators::kPerChannel, true)));
    EXPECT_FALSE(has_separate_channels(two_inputs(Denominators::kPerChannel, false)));
    EXPECT_FALSE(has_separate_channels(two_inputs(Denominators::kPerOutput, true)));
    EXPECT_FALSE(has_separate_channels(TransferStructure::single(1, 0)));
}

TEST(channel_scan, best_start_has_the_delays_of_both_inputs) {  // oracle: the simulated system
    const Vector u = RandomStream(1).normal(600), v = RandomStream(2).normal(600);
    const Vector y = lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 1.0}}, 0, 0.35), u, 0.1) +
                     lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, 3.0}}, 0, 0.8), v, 0.1) +
                     0.05 * RandomStream(3).normal(600);
    Matrix inputs(600, 2);
    inputs << u, v;
    const TransferStructure structure = two_inputs(Denominators::kPerChannel, true);
    const DelayScan scan = scan_channels(IdData(Matrix(y), inputs, 0.1), structure, FitOptions());
    ASSERT_FALSE(scan.starts.empty());
    EXPECT_NEAR(structure.delay(scan.starts[0], 0, 0), 0.35, 0.02);
    EXPECT_NEAR(structure.delay(scan.starts[0], 0, 1), 0.8, 0.02);
}

}  // namespace test_channel_scan
