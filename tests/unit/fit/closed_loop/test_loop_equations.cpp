#include "numerics/fit/closed_loop/loop_equations.h"

#include <gtest/gtest.h>

#include "support/loop_cases.h"

namespace test_loop_equations {

using namespace dynlab;
using namespace dynlab::test;

// oracle: columns by lsim, and the residual of the definition
TEST(loop_equations, hold_filtered_signals_of_all_experiments) {
    const IdData one = loop_data(0.02, 3), data = IdData::merge({one, one});
    const TransferStructure structure = TransferStructure::single(2, 0);
    const DenominatorGroup group(data, structure, 0, Hold::kFoh);
    const auto clean = LoopSignals("a test", data, {loop_controller()}).of_model(loop_plant());
    const LoopEquations equations = loop_equations(group, filter_denominator(3, 2), clean);
    ASSERT_EQ(equations.lengths, (std::vector<Index>{635, 635}));
    const Matrix y_f = state_variable_filter(one.experiments[0].y.col(0), 2, 3, kLoopTs);
    const Matrix x_f = state_variable_filter(clean.experiments[1].x, 2, 3, kLoopTs);
    EXPECT_LT((equations.y.tail(635) - y_f.col(0)).norm(), 1e-10);
    EXPECT_LT((equations.Phi.bottomRows(635).leftCols(2) + y_f.rightCols(2)).norm(), 1e-10);
    EXPECT_LT((equations.Z.bottomRows(635).leftCols(2) + x_f.rightCols(2)).norm(), 1e-10);
    const Vector theta = equations.solution();
    EXPECT_LT((equations.Z.transpose() * (equations.y - equations.Phi * theta)).norm(), 1e-9);
    EXPECT_GT(equations.covariance(theta).diagonal().minCoeff(), 0);
}

}  // namespace test_loop_equations
