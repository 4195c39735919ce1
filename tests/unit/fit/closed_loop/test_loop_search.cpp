#include "numerics/fit/closed_loop/loop_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "support/loop_cases.h"

namespace test_loop_search {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

TEST(loop_search, comes_back_to_the_optimum_from_either_side) {  // oracle: one end from two starts, and its truth
    const IdData data = loop_data(0.02, 3);
    const LoopSignals signals("a test", data, {loop_controller()});
    FitOptions options;
    options.tolerance = 1e-10;
    std::vector<Vector> ends;
    for (const double scale : {0.8, 1.3}) {
        Fit start;
        start.structure = TransferStructure::single(2, 0);
        start.theta = scale * values({4, 3, 2});
        const Fit fit = search_loop(start, data, options, signals);
        EXPECT_EQ(fit.termination, Termination::kConverged);
        EXPECT_THAT(message_text(fit.full_message()), HasSubstr("indirect route"));
        for (Index i = 0; i < 3; ++i) EXPECT_LT(std::abs(fit.theta[i] - values({4, 3, 2})[i]), 4 * fit.std[i]);
        ends.push_back(fit.theta);
    }
    EXPECT_LT(relative_difference(ends[0], ends[1]), 1e-8);
}

}  // namespace test_loop_search
