#include "numerics/fit/closed_loop/loop_signals.h"

#include <gtest/gtest.h>

#include "support/loop_cases.h"

namespace test_loop_signals {

using namespace dynlab;
using namespace dynlab::test;

TEST(loop_signals, the_projection_is_what_the_reference_makes_of_the_input) {  // oracle: the loop without noise
    const IdData data = loop_data(0.02, 3);
    const auto clean = ClosedLoop(loop_plant(), loop_controller(), kLoopTs).to_reference(data.experiments[0].r.col(0));
    const Vector projected = LoopSignals("a test", data, {}).projected_inputs().front();
    const double noise = (data.experiments[0].u.col(0) - clean.u).norm();
    EXPECT_LT((projected - clean.u).norm(), 0.5 * noise);
    EXPECT_EQ(with_projected_inputs(data, LoopSignals("a test", data, {})).experiments[0].u.col(0), projected);
}

TEST(loop_signals, a_known_controller_is_simulated) {  // oracle: the loop without noise
    const IdData data = loop_data(0.02, 3);
    const LoopSignals signals("a test", data, {loop_controller()});
    const LoopSignals::All all = signals.of_model(loop_plant());
    const auto clean = ClosedLoop(loop_plant(), loop_controller(), kLoopTs).to_reference(data.experiments[0].r.col(0));
    EXPECT_TRUE(all.in_loop);
    EXPECT_EQ(all.experiments.front().u, clean.u);
    EXPECT_EQ(all.experiments.front().x, clean.x);
    EXPECT_FALSE(signals.warning());
}

TEST(loop_signals, the_record_shows_how_late_the_controller_answers) {  // oracle: how the data were made
    for (const Index late : {0, 1}) {
        const Vector r = prbs(7, 5);
        LoopController controller = loop_controller();
        controller.computing_delay = late;
        const IdData data =
            ClosedLoop(loop_plant(), controller, kLoopTs).simulate(r, 0.05 * RandomStream(3).normal(r.size()));
        controller.computing_delay = 0;
        const LoopSignals signals("a test", data, {controller, true});
        EXPECT_EQ(signals.controller()->computing_delay, late);
    }
}

}  // namespace test_loop_signals
