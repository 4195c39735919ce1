#include <gtest/gtest.h>

#include "numerics/fit/operating_points.h"

namespace test_operating_points {

using namespace dynlab;

TEST(operating_points, come_off_and_go_back) {  // oracle: the definition, a step and a swing
    Matrix step(4, 1), swing(4, 1), y(4, 2);
    step << 2, 2, 5, 5;
    swing << 1, 3, 1, 3;
    y << 10, 1, 20, 1, 30, 2, 40, 2;
    const IdData data = IdData::merge({IdData(y, step, 1), IdData(y, swing, 1)});
    const CenteredData centered = without_operating_points(data);
    EXPECT_EQ(centered.data.experiments[0].u(0, 0), 0);   // the step rests at its first value,
    EXPECT_EQ(centered.removed[0][0].output, 20);         // up to the sample of the step: (10 + 20 + 30)/3
    EXPECT_EQ(centered.data.experiments[1].u(0, 0), -1);  // the other swings about its mean
    EXPECT_EQ(centered.removed[1][0].output, 25);
    EXPECT_EQ(centered.removed[1][1].output, 1.5);
    Fit fit;
    fit.offsets = Matrix::Constant(2, 2, 0.5);
    add_operating_points(fit, centered.removed);
    EXPECT_EQ(fit.offsets(0, 0), 20.5);
    EXPECT_EQ(fit.offsets(1, 1), 2);
    EXPECT_EQ(fit.removed.size(), 2u);
    EXPECT_TRUE(centered_for(data, Offset::kEstimate).removed.empty());
    EXPECT_EQ(centered_for(data, Offset::kEstimate).data.experiments[0].y, y);
    EXPECT_EQ(centered_for(data, Offset::kRemove).data.experiments[1].u, centered.data.experiments[1].u);
}

}  // namespace test_operating_points
